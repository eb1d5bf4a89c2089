//! Equalities: hinges that follow others, and points of two bodies that stay together.

use nalgebra::{Isometry3, Point3};

use super::element::Element;
use super::tree::{Site, Tree};
use crate::error::ModelError;
use crate::model::{Connection, Coupling, Hinge, Link};

/// Most equalities of a kind.
const EQUALITIES_MAX: usize = 256;
/// Attributes of the softness.
const SOFTNESS: [&str; 2] = ["solref", "solimp"];

/// What an equality may name.
pub(super) struct EqualityReader<'a> {
    pub(super) tree: &'a Tree,
    pub(super) hinges: &'a [Hinge],
    pub(super) links: &'a [Link],
    /// Pose in its rigid body's frame of each MJCF body that moves.
    pub(super) offsets: &'a [Option<Isometry3<f64>>],
}

impl EqualityReader<'_> {
    /// Returns all equalities that act.
    pub(super) fn read(&self) -> Result<(Vec<Coupling>, Vec<Connection>), ModelError> {
        let (mut couplings, mut connections) = (Vec::new(), Vec::new());
        for equality in self.tree.equalities.iter().filter(|equality| equality.is_true("active", true)) {
            match equality.tag.as_str() {
                "equality/joint" => couplings.push(self.coupling(equality)?),
                _ => connections.push(self.connection(equality)?),
            }
            if couplings.len().max(connections.len()) > EQUALITIES_MAX {
                return Err(equality.refused(format!("there are more than {EQUALITIES_MAX} equalities of its kind")));
            }
        }
        Ok((couplings, connections))
    }

    fn coupling(&self, equality: &Element) -> Result<Coupling, ModelError> {
        let hinge = |side: &str| {
            let Some(name) = equality.get(side) else { return Ok(None) };
            let found = self.hinges.iter().position(|hinge| hinge.name == name);
            found
                .map(Some)
                .ok_or_else(|| equality.refused(format!("its `{side}` `{name}` is not a hinge of the model")))
        };
        let first = hinge("joint1")?.ok_or_else(|| equality.refused("`joint1` is missing"))?;
        let second = hinge("joint2")?;
        if second == Some(first) {
            return Err(equality.refused("`joint1` and `joint2` are the same"));
        }
        let [constant, ratio, powers @ ..] = equality.list_over("polycoef", [0.0, 1.0, 0.0, 0.0, 0.0]);
        if second.is_some() && powers != [0.0; 3] {
            let expected = "0 in its last three numbers: a hinge may follow another one in proportion only";
            return Err(equality.wrong("polycoef", expected));
        }
        // MuJoCo counts both angles from the pose of the text.
        let of_other = second.map_or(0.0, |other| ratio * self.hinges[other].nominal_rad);
        Ok(Coupling {
            name: equality.label.clone(),
            hinge: first,
            follows: second.map(|other| (other, ratio)),
            offset_rad: self.hinges[first].nominal_rad + constant - of_other,
            softness: equality.softness(SOFTNESS)?.softness(),
        })
    }

    fn connection(&self, equality: &Element) -> Result<Connection, ModelError> {
        let has = |name: &str| equality.get(name).is_some();
        let places = match (has("body1") && has("anchor"), has("site1") && has("site2")) {
            (true, false) if !has("site1") && !has("site2") => self.places_of_bodies(equality)?,
            (false, true) if !has("body1") && !has("body2") && !has("anchor") => {
                [self.place_of_site(equality, "site1")?, self.place_of_site(equality, "site2")?]
            }
            _ => return Err(equality.refused("give either `body1`, `body2` and `anchor`, or `site1` and `site2`")),
        };
        let side = |(body, point): (usize, Point3<f64>)| {
            let name = &self.tree.bodies[body].name;
            let link = self.links.iter().position(|link| link.name == *name);
            let Some((link, offset)) = link.zip(self.offsets[body]) else {
                let problem = format!("`{name}` does not move; a robot that hangs on the world is not simulated");
                return Err(equality.refused(problem));
            };
            Ok((link, offset * point))
        };
        let [first, second] = [side(places[0])?, side(places[1])?];
        if self.links[first.0].body == self.links[second.0].body {
            return Err(equality.refused("both of its points belong to one rigid body; remove it"));
        }
        Ok(Connection {
            name: equality.label.clone(),
            links: [first.0, second.0],
            points_m: [first.1, second.1],
            softness: equality.softness(SOFTNESS)?.softness(),
        })
    }

    /// Returns both bodies with the anchor in their frames, where it is in the pose of the text.
    fn places_of_bodies(&self, equality: &Element) -> Result<[(usize, Point3<f64>); 2], ModelError> {
        let body = |side: &str| {
            let name = equality.get(side).unwrap_or("world");
            let found = self.tree.bodies.iter().position(|body| body.name == name);
            found.ok_or_else(|| equality.refused(format!("there is no body `{name}`")))
        };
        let bodies = [body("body1")?, body("body2")?];
        let anchor = Point3::from(equality.list_over("anchor", [0.0; 3]));
        let [first, second] = bodies.map(|body| self.pose(body));
        Ok([(bodies[0], anchor), (bodies[1], second.inverse() * (first * anchor))])
    }

    /// Returns the pose of a body in the world, as in the text.
    fn pose(&self, body: usize) -> Isometry3<f64> {
        let of = &self.tree.bodies[body];
        if body == 0 { Isometry3::identity() } else { self.pose(of.parent) * of.pose.isometry() }
    }

    fn place_of_site(&self, equality: &Element, side: &str) -> Result<(usize, Point3<f64>), ModelError> {
        let name = equality.get(side).unwrap_or_default();
        let mut found = self.tree.sites.iter().filter(|site| site.name == name);
        match (found.next(), found.next()) {
            (Some(Site { body, point_m: Some(point), .. }), None) => Ok((*body, *point)),
            (Some(_), None) => {
                Err(equality.refused(format!("site `{name}` has its place from a class; give the site its own `pos`")))
            }
            (Some(_), Some(_)) => Err(equality.refused(format!("there are two sites `{name}`"))),
            (None, _) => Err(equality.refused(format!("there is no site `{name}`"))),
        }
    }
}
