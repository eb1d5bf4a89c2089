//! Random robots on random grounds, driven by random controls: any model that loads must simulate without a panic.

use std::fmt::Write;

use treadmill_humanoid::{EnvConfig, EnvironmentConfig, Model, Physics};

/// Control steps of each robot.
const STEPS: usize = 12;
/// Robots that step together.
const WORLDS: usize = 3;
/// Most bodies of a robot, besides its trunk.
const BODIES_MAX: usize = 9;

/// Numbers drawn from bytes; 0 after their end.
struct Draws<'a>(&'a [u8]);

impl Draws<'_> {
    fn byte(&mut self) -> u8 {
        let Some((first, rest)) = self.0.split_first() else { return 0 };
        self.0 = rest;
        *first
    }

    /// Returns a whole number below `end`.
    fn below(&mut self, end: usize) -> usize {
        usize::from(self.byte()) % end
    }

    fn chance(&mut self) -> bool {
        self.byte() > 127
    }

    /// Returns a number from −1 to 1.
    fn unit(&mut self) -> f64 {
        f64::from(i16::from_le_bytes([self.byte(), self.byte()])) / 32768.0
    }

    /// Returns a positive number, `middle` times up to `spread` or its inverse.
    fn around(&mut self, middle: f64, spread: f64) -> f64 {
        middle * spread.powf(self.unit())
    }

    /// Returns a number of any size and sign.
    fn wild(&mut self) -> f64 {
        match self.below(8) {
            0 => 0.0,
            1 => self.unit() * 1e12,
            2 => self.unit() * 1e-12,
            _ => self.unit() * 10.0,
        }
    }

    fn direction(&mut self) -> String {
        format!("{} {} {}", self.unit(), self.unit(), self.unit() + 0.001)
    }
}

/// Builds a robot from bytes; if its model loads, simulates it alone and beside others, from wild states.
///
/// # Panics
/// If a simulation panics, a world depends on its neighbours, or a state is not finite although there was no fault.
pub fn robot(data: &[u8]) {
    let mut draws = Draws(data);
    let Ok(model) = Model::from_mjcf(&text(&mut draws)) else { return };
    let config = EnvironmentConfig::from(EnvConfig {
        substeps: 1 + draws.below(4) as u32,
        control_step_s: [0.001, 0.015, 0.1][draws.below(3)],
        ..EnvConfig::default()
    });
    let new = || Physics::new(model.clone(), &config).expect("a model that loads can be simulated");
    let mut together: Vec<Physics> = (0..WORLDS).map(|_| new()).collect();
    let mut alone = new();
    for (index, physics) in together.iter_mut().enumerate() {
        let (mut position, mut velocity) = (model.nominal_position(), vec![0.0; model.velocity_size()]);
        if draws.chance() {
            position.iter_mut().for_each(|number| *number += draws.wild());
            velocity.iter_mut().for_each(|number| *number += draws.wild());
        }
        if physics.try_set_state(&position, &velocity).is_ok() && index == 0 {
            alone.set_state(&position, &velocity);
        }
    }
    for _ in 0..STEPS {
        let controls: Vec<f32> = model.motors.iter().map(|_| draws.wild() as f32).collect();
        for physics in &mut together {
            let _ = physics.set_controls(&controls);
        }
        Physics::step_together(&mut together.iter_mut());
        let _ = alone.step_only(&controls);
        for physics in &mut together {
            if physics.check_step().is_ok() {
                let mut numbers = physics.position().iter().chain(physics.velocity());
                assert!(numbers.all(|number| number.is_finite()), "a number is not finite without a fault");
            }
        }
        assert_eq!(together[0].is_faulty(), alone.is_faulty(), "a fault depends on neighbours");
        assert_eq!(together[0].position(), alone.position(), "a position depends on neighbours");
        assert_eq!(together[0].velocity(), alone.velocity(), "a velocity depends on neighbours");
    }
}

/// Returns the text of a robot.
fn text(draws: &mut Draws<'_>) -> String {
    let mut joints = Vec::new();
    let mut body = String::new();
    let trunk = shape(draws);
    let count = draws.below(BODIES_MAX + 1);
    limb(draws, count, &mut body, &mut joints);
    let mut motors = String::new();
    for joint in &joints {
        let _ = writeln!(motors, "{}", motor(draws, joint));
    }
    let pairs = if draws.chance() { "<pair geom1=\"g0\" geom2=\"ground\"/>" } else { "" };
    let tendon = match (draws.chance(), joints.first(), joints.last()) {
        (true, Some(first), Some(last)) if first != last => format!(
            "<tendon><fixed limited=\"true\" range=\"{} {}\"><joint joint=\"{first}\" coef=\"{}\"/>\
             <joint joint=\"{last}\" coef=\"1\"/></fixed></tendon>",
            -draws.around(0.3, 10.0),
            draws.around(0.3, 10.0),
            draws.unit()
        ),
        _ => String::new(),
    };
    let (asset, ground) = ground(draws);
    format!(
        "<mujoco><compiler angle=\"radian\"/><option gravity=\"0 0 {}\"/><asset>{asset}\
         <mesh name=\"hull\" vertex=\"{}\"/></asset><worldbody>{ground}<body pos=\"0 0 {}\">\
         <joint name=\"root\" type=\"free\" damping=\"{}\" frictionloss=\"{}\"/>{trunk}{body}</body></worldbody>\
         <contact>{pairs}</contact>{tendon}<actuator>{motors}</actuator></mujoco>",
        -draws.around(9.81, 3.0),
        (0..5).map(|_| draws.direction()).collect::<Vec<_>>().join(" "),
        draws.around(1.0, 3.0),
        if draws.chance() { draws.around(1.0, 1e3) } else { 0.0 },
        if draws.chance() { draws.around(1.0, 1e3) } else { 0.0 },
    )
}

/// Writes `count` bodies below each other or side by side.
fn limb(draws: &mut Draws<'_>, count: usize, body: &mut String, joints: &mut Vec<String>) {
    let mut open = 0;
    for _ in 0..count {
        let _ = write!(body, "<body pos=\"{}\">", draws.direction());
        open += 1;
        for _ in 0..1 + draws.below(3) {
            let name = format!("j{}", joints.len());
            let _ = write!(
                body,
                "<joint name=\"{name}\" axis=\"{}\" range=\"{} {}\" limited=\"{}\" damping=\"{}\" armature=\"{}\" \
                 stiffness=\"{}\" frictionloss=\"{}\" solreflimit=\"{}\" solimplimit=\"{}\"/>",
                draws.direction(),
                -draws.around(0.5, 10.0),
                draws.around(0.5, 10.0),
                draws.chance(),
                draws.around(1.0, 1e4),
                draws.around(0.01, 1e3),
                if draws.chance() { draws.around(1.0, 1e6) } else { 0.0 },
                if draws.chance() { draws.around(1.0, 1e4) } else { 0.0 },
                softness(draws),
                impedance(draws),
            );
            joints.push(name);
        }
        let _ = write!(body, "{}", shape(draws));
        if draws.chance() {
            body.push_str("</body>");
            open -= 1;
        }
    }
    body.push_str(&"</body>".repeat(open));
}

fn shape(draws: &mut Draws<'_>) -> String {
    let size = draws.around(0.1, 20.0);
    let form = [
        format!("type=\"sphere\" size=\"{size}\""),
        format!("type=\"capsule\" size=\"{size} {}\"", draws.around(0.2, 20.0)),
        format!("type=\"cylinder\" size=\"{size} {}\"", draws.around(0.2, 20.0)),
        format!("type=\"box\" size=\"{size} {} {}\"", draws.around(0.1, 20.0), draws.around(0.1, 20.0)),
        "type=\"mesh\" mesh=\"hull\"".to_owned(),
    ];
    format!(
        "<geom {} pos=\"{}\" mass=\"{}\" friction=\"{}\" condim=\"{}\" margin=\"{}\" solref=\"{}\" solimp=\"{}\"/>",
        form[draws.below(5)],
        draws.direction(),
        draws.around(1.0, 1e4),
        draws.around(1.0, 1e3),
        [1, 3][draws.below(2)],
        if draws.chance() { 0.005 } else { 0.0 },
        softness(draws),
        impedance(draws),
    )
}

fn softness(draws: &mut Draws<'_>) -> String {
    match draws.below(4) {
        0 => format!("{} {}", -draws.around(1e3, 1e4), -draws.around(10.0, 1e3)),
        1 => format!("{} {}", draws.around(0.02, 1e3), draws.around(1.0, 1e2)),
        _ => "0.02 1".to_owned(),
    }
}

fn impedance(draws: &mut Draws<'_>) -> String {
    match draws.below(3) {
        0 => format!(
            "{} {} {} {} {}",
            draws.unit().abs(),
            draws.unit().abs(),
            draws.around(1e-3, 1e3),
            draws.unit().abs(),
            1.0 + 4.0 * draws.unit().abs()
        ),
        _ => "0.9 0.95 0.001 0.5 2".to_owned(),
    }
}

fn motor(draws: &mut Draws<'_>, joint: &str) -> String {
    let gear = draws.around(1.0, 1e3);
    match draws.below(4) {
        0 => format!("<motor joint=\"{joint}\" gear=\"{gear}\" ctrlrange=\"-1 1\"/>"),
        1 => format!(
            "<position joint=\"{joint}\" kp=\"{}\" kv=\"{}\" ctrlrange=\"-1 1\" forcerange=\"-{} 5\"/>",
            draws.around(100.0, 1e6),
            draws.around(10.0, 1e6),
            draws.around(1.0, 1e4)
        ),
        2 => format!(
            "<position joint=\"{joint}\" kp=\"{}\" dampratio=\"1\" ctrlrange=\"-1 1\"/>",
            draws.around(100.0, 1e6)
        ),
        _ => format!(
            "<velocity joint=\"{joint}\" kv=\"{}\" gear=\"{gear}\" ctrlrange=\"-9 9\"/>",
            draws.around(10.0, 1e6)
        ),
    }
}

/// Returns the asset and the geom of the ground.
fn ground(draws: &mut Draws<'_>) -> (String, String) {
    if draws.chance() {
        return (String::new(), "<geom name=\"ground\" type=\"plane\" size=\"1 1 1\"/>".to_owned());
    }
    let (rows, columns) = (2 + draws.below(9), 2 + draws.below(9));
    let heights: Vec<String> = (0..rows * columns).map(|_| draws.unit().abs().to_string()).collect();
    let asset = format!(
        "<hfield name=\"h\" nrow=\"{rows}\" ncol=\"{columns}\" size=\"{} {} {} 0.1\" elevation=\"{}\"/>",
        draws.around(3.0, 10.0),
        draws.around(3.0, 10.0),
        draws.around(0.2, 10.0),
        heights.join(" ")
    );
    (asset, "<geom name=\"ground\" type=\"hfield\" hfield=\"h\"/>".to_owned())
}
