//! Links that are compared with the motion: those that the settings name, or those that the robot's shape suggests.

use crate::config::MotionConfig;
use crate::error::ModelError;
use crate::model::Model;
use crate::physics::Physics;

/// Fewest hinges of a limb: a neck has two.
const LIMB_HINGES_MIN: usize = 3;
/// Distance between neighbours of a limb that are compared, as a share of its length.
const APART_SHARE: f64 = 0.15;

/// Links that are compared, as indices of [`Model::links`].
#[derive(Clone, Debug, PartialEq)]
pub struct Compared {
    /// Frame of comparison.
    pub anchor: usize,
    /// Compared links.
    pub links: Vec<usize>,
    /// Ends of the limbs, as indices into `links`.
    pub ends: Vec<usize>,
}

impl Compared {
    /// Returns the links that the settings name or leave to be found, for a robot in its default pose.
    ///
    /// # Errors
    /// [`ModelError`] if a link does not exist.
    pub fn of(config: &MotionConfig, physics: &Physics) -> Result<Self, ModelError> {
        let model = physics.model();
        let find = |key: &str, name: &str| {
            model.links.iter().position(|link| link.name == name).ok_or_else(|| {
                let known: Vec<&str> = model.links.iter().map(|link| &*link.name).collect();
                ModelError::Task(format!("{key}: the model has no link `{name}`; it has: {}", known.join(", ")))
            })
        };
        let body = Shape { model };
        let anchor = match config.anchor.as_str() {
            "" => body.link(body.trunk()),
            name => find("motion.anchor", name)?,
        };
        let limbs = body.limbs();
        let ends: Vec<usize> = match &config.end_effectors[..] {
            [] => limbs.iter().filter_map(|limb| limb.last()).map(|end| body.link(*end)).collect(),
            names => names.iter().map(|name| find("motion.end_effectors", name)).collect::<Result<_, _>>()?,
        };
        let mut links: Vec<usize> = match &config.bodies[..] {
            [] => {
                let apart = limbs.iter().flat_map(|limb| apart(limb, physics)).map(|part| body.link(part));
                [0, anchor].into_iter().chain(apart).collect()
            }
            names => {
                let named = names.iter().map(|name| find("motion.bodies", name));
                named.chain([Ok(anchor)]).collect::<Result<_, _>>()?
            }
        };
        links.extend(&ends);
        let mut seen = vec![false; model.links.len()];
        links.retain(|link| !std::mem::replace(&mut seen[*link], true));
        let place = |end: &usize| links.iter().position(|link| link == end).unwrap_or_default();
        Ok(Self { anchor, ends: ends.iter().map(place).collect(), links })
    }
}

/// Tree of a robot's bodies.
struct Shape<'a> {
    model: &'a Model,
}

impl Shape<'_> {
    fn children(&self, body: usize) -> impl Iterator<Item = usize> + '_ {
        (0..self.model.bodies.len()).filter(move |child| self.model.bodies[*child].parent == Some(body))
    }

    /// Returns whether a limb begins with a body: whether so many hinges follow one another below it.
    fn begins_limb(&self, body: usize) -> bool {
        self.hinges_below(body) >= LIMB_HINGES_MIN
    }

    /// Returns the most hinges on a way from a body down, its own included.
    fn hinges_below(&self, body: usize) -> usize {
        let below = self.children(body).map(|child| self.hinges_below(child)).max().unwrap_or(0);
        self.model.bodies[body].hinges.len() + below
    }

    /// Returns the body other than the base, and nearest to it, from which several limbs begin; else the base.
    fn trunk(&self) -> usize {
        let several = |body: &usize| self.children(*body).filter(|child| self.begins_limb(*child)).count() > 1;
        let nearest = |body: &usize| self.model.upward(*body).count();
        (1..self.model.bodies.len()).filter(several).min_by_key(nearest).unwrap_or(0)
    }

    /// Returns the limbs, each from where it begins at the base or the trunk to where it ends or branches.
    fn limbs(&self) -> Vec<Vec<usize>> {
        let trunk = self.trunk();
        let to_trunk: Vec<usize> = self.model.upward(trunk).collect();
        let mut from = vec![0, trunk];
        from.dedup();
        let starts = from.into_iter().flat_map(|body| self.children(body));
        let starts = starts.filter(|body| !to_trunk.contains(body) && self.begins_limb(*body));
        let chain = |start: usize| {
            std::iter::successors(Some(start), |body| {
                let mut children = self.children(*body);
                children.next().filter(|_| children.next().is_none())
            })
        };
        starts.map(|start| chain(start).collect()).collect()
    }

    /// Returns the link that gives a body its frame.
    fn link(&self, body: usize) -> usize {
        self.model.links.iter().position(|link| link.body == body).unwrap_or_default()
    }
}

/// Returns the bodies of a limb that lie apart from each other, from its end on, in the pose of `physics`.
fn apart(limb: &[usize], physics: &Physics) -> Vec<usize> {
    let place = |body: usize| physics.body_motion(body).pose.translation.vector;
    let distance_m = |one: usize, other: usize| (place(one) - place(other)).norm();
    let length_m: f64 = limb.windows(2).map(|pair| distance_m(pair[0], pair[1])).sum();
    let mut chosen: Vec<usize> = Vec::new();
    for body in limb.iter().rev() {
        if chosen.last().is_none_or(|last| distance_m(*last, *body) > APART_SHARE * length_m) {
            chosen.push(*body);
        }
    }
    chosen.reverse();
    chosen
}
