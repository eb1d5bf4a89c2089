//! Pairs of shapes, their contact parameters, and refusals of `<pair>`s; compared with MuJoCo's contacts.

use treadmill_humanoid::Model;
use treadmill_humanoid::model::{Pair, ShapeIndex, Softness};

use crate::support::{Text, changed, problem};

/// Bodies with bits, classes, exclusions, priorities and explicit pairs of all kinds.
pub const TOUCH: &str = r"
<mujoco><compiler angle='radian'/>
  <default><geom solimp='0.8'/><default class='slick'><geom condim='1' friction='0.9'/><pair friction='0.3 0.3' margin='0.004'/></default></default>
  <worldbody>
    <geom name='floor' type='plane' size='1 1 1' friction='0.4' solref='0.05 0.5' solmix='3' margin='0.002'/>
    <body name='base' pos='0 0 1'><freejoint/>
      <geom name='trunk' size='0.1' class='slick' margin='0.001'/>
      <body name='welded' pos='0 0.1 0'><geom name='lump' size='0.05' contype='2' conaffinity='0'/></body>
      <body name='left' pos='0.3 0 0'><joint name='l' axis='0 1 0'/>
        <geom name='thigh' type='capsule' size='0.05 0.1' class='slick' solref='-500 -20'/>
        <body name='foot' pos='0 0 -0.3'><joint name='f' axis='0 1 0'/>
          <geom name='sole' type='box' size='0.1 0.05 0.02' friction='1.2' priority='1' solref='0.01 1' solimp='0.99 0.5 0.002 0.3 1'/>
          <geom name='heel' size='0.02' contype='0' conaffinity='2'/></body></body>
      <body name='right' pos='-0.3 0 0'><joint name='r' axis='0 1 0'/>
        <geom name='shin' type='capsule' size='0.05 0.1' solmix='0' friction='0.2'/>
        <geom name='ghost' size='0.05' contype='0' conaffinity='0'/></body>
    </body>
  </worldbody>
  <contact>
    <exclude body1='foot' body2='world'/><exclude body1='left' body2='right'/>
    <pair geom1='ghost' geom2='floor' class='slick'/>
    <pair geom1='sole' geom2='thigh' condim='1' solref='-300 -10'/>
    <pair geom1='floor' geom2='sole' friction='0.7 0.7 0.1' solref='0.04'/>
  </contact>
  <actuator><motor joint='l'/></actuator>
</mujoco>";

fn name(model: &Model, index: Option<ShapeIndex>) -> &str {
    index.map_or(&model.ground.name, |index| &model.bodies[index.body].shapes[index.shape].name)
}

/// Returns the softness of MuJoCo's `solref` and `solimp`.
fn softness([first, second]: [f64; 2], impedance: [f64; 5]) -> Softness {
    let end = impedance[1];
    if first > 0.0 {
        let stiffness = 1.0 / (end * first * second).powi(2);
        return Softness { stiffness, damping: 2.0 / (end * first), impedance };
    }
    Softness { stiffness: -first / (end * end), damping: -second / end, impedance }
}

fn assert_pair(model: &Model, pair: &Pair, names: [&str; 2], friction: f64, margin_m: f64, wanted: Softness) {
    assert_eq!([name(model, Some(pair.first)), name(model, pair.second)], names);
    assert!(pair.friction.iter().all(|own| (own - friction).abs() < 1e-12), "{names:?}: {:?}", pair.friction);
    assert!((pair.margin_m - margin_m).abs() < 1e-12, "{names:?}: {}", pair.margin_m);
    let found = pair.softness;
    assert!((found.stiffness / wanted.stiffness - 1.0).abs() < 1e-12, "{names:?}: {found:?}");
    assert!((found.damping / wanted.damping - 1.0).abs() < 1e-12, "{names:?}: {found:?}");
    for (found, wanted) in found.impedance.into_iter().zip(wanted.impedance) {
        assert!((found - wanted).abs() < 1e-12, "{names:?}: {found} instead of {wanted}");
    }
}

#[test]
fn pairs_and_their_parameters_are_mujocos() {
    let model = Model::from_mjcf(TOUCH).expect("valid");
    let geoms = [0.8, 0.95, 0.001, 0.5, 2.0];
    let pairs = [0.9, 0.95, 0.001, 0.5, 2.0];
    let sole = [0.99, 0.5, 0.002, 0.3, 1.0];
    // MuJoCo 4.0's contacts with all shapes enlarged and at one point: friction, margin, solref and solimp.
    let wanted = [
        (["trunk", "floor"], 0.9, 0.003, softness([0.0425, 0.625], geoms)),
        (["thigh", "floor"], 0.9, 0.002, softness([-500.0, -20.0], geoms)),
        (["sole", "floor"], 0.7, 0.0, softness([0.04, 1.0], pairs)),
        (["shin", "floor"], 0.4, 0.002, softness([0.05, 0.5], geoms)),
        (["ghost", "floor"], 0.3, 0.004, softness([0.02, 1.0], pairs)),
        (["trunk", "sole"], 1.2, 0.001, softness([0.01, 1.0], sole)),
        (["lump", "heel"], 1.0, 0.0, softness([0.02, 1.0], geoms)),
        (["thigh", "sole"], 0.0, 0.0, softness([-300.0, -10.0], pairs)),
        (["sole", "shin"], 1.2, 0.0, softness([0.01, 1.0], sole)),
    ];
    let names = |pair: &Pair| format!("{} {}", name(&model, Some(pair.first)), name(&model, pair.second));
    assert_eq!(model.pairs.len(), wanted.len(), "{:?}", model.pairs.iter().map(names).collect::<Vec<_>>());
    for (pair, (names, friction, margin_m, softness)) in model.pairs.iter().zip(wanted) {
        assert_pair(&model, pair, names, friction, margin_m, softness);
    }
    assert_eq!((model.ground.friction, model.ground.margin_m), (0.4, 0.002));
}

#[test]
fn a_priority_of_the_floor_decides_all_its_contacts() {
    let text = changed(TOUCH, "solmix='3'", "solmix='3' priority='2' condim='1'");
    let model = Model::from_mjcf(&text).expect("valid");
    let floor = softness([0.05, 0.5], [0.8, 0.95, 0.001, 0.5, 2.0]);
    assert_pair(&model, &model.pairs[0], ["trunk", "floor"], 0.0, 0.003, floor);
    assert_eq!(model.pairs[2].friction, [0.7, 0.7], "an explicit pair ignores priorities");
}

#[test]
fn forty_limbs_have_all_their_pairs() {
    let limb = "<body><joint/><geom size='0.02'/></body>".repeat(40);
    let text = changed(TOUCH, "<body name='right'", &format!("{limb}<body name='right'"));
    let model = Model::from_mjcf(&text).expect("more than 31 bodies");
    // Each limb touches floor, thigh, sole, shin and the other limbs, but not its parent's trunk; heel and lump differ
    // in bits.
    assert_eq!(model.pairs.len(), 9 + 40 * 4 + 40 * 39 / 2);
}

#[test]
fn impossible_pairs_are_refused_by_name() {
    let pair = "<pair geom1='ghost' geom2='floor' class='slick'/>";
    Text(TOUCH).assert_refused(&[
        (pair, "<pair geom1='ghost'/>", &["pair", "geom2", "missing"]),
        (pair, "<pair geom1='ghost' geom2='wing'/>", &["pair of ghost and wing", "no geom `wing`"]),
        (pair, "<pair name='odd' geom1='ghost' geom2='shin'/>", &["odd", "one rigid body"]),
        (pair, "<pair geom1='lump' geom2='trunk'/>", &["pair of lump and trunk", "one rigid body"]),
        (pair, "<pair geom1='floor' geom2='floor'/>", &["one rigid body"]),
        (pair, "<pair geom1='sole' geom2='floor'/>", &["pair of floor and sole", "two pairs"]),
        (pair, "<pair geom1='ghost' geom2='floor' friction='0.7 -1'/>", &["ghost", "friction", "-1"]),
        (pair, "<pair geom1='ghost' geom2='floor' friction='-1 -1'/>", &["ghost", "friction", "-1"]),
        (pair, "<pair geom1='ghost' geom2='floor' condim='2'/>", &["ghost", "condim", "1, 3, 4 or 6"]),
        (pair, "<pair geom1='ghost' geom2='floor' margin='0.03'/>", &["ghost", "margin", "0.02"]),
        (pair, "<pair geom1='ghost' geom2='floor' solref='0.02 -1'/>", &["ghost", "solref"]),
        (pair, "<pair geom1='ghost' geom2='floor' solreffriction='0.02 1'/>", &["ghost", "solreffriction"]),
        (pair, "<pair geom1='ghost' geom2='floor' class='rough'/>", &["ghost", "rough"]),
    ]);
    let wall = "<worldbody><geom name='wall' type='box' size='1 1 1' contype='0' conaffinity='0'/>";
    let walled = changed(&changed(TOUCH, "<worldbody>", wall), "geom2='floor'", "geom2='wall'");
    assert!(problem(&walled).contains("`wall`") && problem(&walled).contains("static"));
}

#[test]
fn an_exclusion_holds_for_its_own_static_body_alone() {
    let touches_floor = |excluded: &str, floor_is_in: &str| {
        let floor = "<geom type='plane' size='1 1 1'/>";
        let [of_world, of_table] = if floor_is_in == "world" { [floor, ""] } else { ["", floor] };
        let model = Model::from_mjcf(&format!(
            r"<mujoco><worldbody>{of_world}<body name='table'>{of_table}</body><body name='base'><freejoint/>
               <geom size='0.1'/><body><joint name='j'/><geom size='0.1'/></body></body></worldbody>
               <contact><exclude body1='{excluded}' body2='base'/></contact><actuator><motor joint='j'/></actuator></mujoco>"
        ));
        model.expect("valid").pairs.iter().filter(|pair| pair.second.is_none()).count() == 2
    };
    assert!(touches_floor("table", "world") && touches_floor("world", "table"));
    assert!(!touches_floor("world", "world") && !touches_floor("table", "table"));
}
