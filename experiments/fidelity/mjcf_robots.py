"""Random robots as MJCF, which combine features of many kinds, for `mjcf_diff.py`."""

import random

from experiments.fidelity.mjcf_cases import equality


def robot(seed: int, index: int) -> str:
    """Returns a random robot, the same for the same numbers."""
    return RandomRobot(random.Random(f"{seed} {index}")).text()


class RandomRobot:
    """Writes one random robot."""

    BODIES_MAX = 7
    DEPTH_MAX = 3

    def __init__(self, chance: random.Random):
        self.chance = chance
        self.joints: list[str] = []
        self.bodies: list[str] = []
        self.classes = chance.random() < 0.4

    def number(self, low: float, high: float) -> str:
        return f"{self.chance.uniform(low, high):.4g}"

    def numbers(self, count: int, low: float, high: float) -> str:
        return " ".join(self.number(low, high) for _ in range(count))

    def some(self, *choices: str, often: float = 0.3) -> str:
        """Returns each of these attributes by chance."""
        return " ".join(choice for choice in choices if self.chance.random() < often)

    def turn(self) -> str:
        return self.chance.choice(
            (
                "",
                "",
                f'euler="{self.numbers(3, -60, 60)}"',
                f'quat="{self.numbers(4, -1, 1)}"',
                f'axisangle="{self.numbers(3, -1, 1)} {self.number(-90, 90)}"',
                f'zaxis="{self.numbers(3, 0.1, 1)}"',
                f'xyaxes="1 {self.number(-1, 1)} 0 0 1 {self.number(-1, 1)}"',
            )
        )

    def geom(self) -> str:
        kind = self.chance.choice(("sphere", "capsule", "box", "cylinder", "ellipsoid"))
        size = {"sphere": 1, "capsule": 2, "cylinder": 2}.get(kind, 3)
        extra = self.some(
            f'density="{self.number(200, 2000)}"',
            f'friction="{self.number(0.2, 1.2)}"',
            f'solref="{self.number(0.01, 0.05)} {self.number(0.5, 1.5)}"',
            f'group="{self.chance.randint(0, 5)}"',
            'condim="1"',
            often=0.2,
        )
        # Edges and faces touch by rules of their own in each engine; spheres and capsules by one formula.
        bits = self.chance.randint(0, 3), self.chance.randint(0, 3)
        bits = bits if kind in ("sphere", "capsule") else (0, 0)
        extra += ' contype="{}" conaffinity="{}"'.format(*bits)
        place = self.numbers(3, -0.1, 0.1)
        return f'<geom type="{kind}" size="{self.numbers(size, 0.03, 0.08)}" pos="{place}" {self.turn()} {extra}/>'

    def joint(self, may_have_ref: bool) -> str:
        name = f"j{len(self.joints)}"
        self.joints.append(name)
        low, high = self.chance.uniform(-90, -5), self.chance.uniform(5, 90)
        extra = self.some(
            f'range="{low:.3g} {high:.3g}"',
            f'stiffness="{self.number(1, 20)}" springref="{self.number(-30, 30)}"',
            f'damping="{self.number(0.1, 2)}"',
            f'armature="{self.number(0.001, 0.1)}"',
            f'frictionloss="{self.number(0.05, 0.5)}"',
            f'pos="{self.numbers(3, -0.05, 0.05)}"',
            f'margin="{self.number(0, 0.2)}"',
            f'actuatorfrcrange="-{self.number(1, 20)} {self.number(1, 20)}"',
        )
        if may_have_ref and self.chance.random() < 0.2:
            extra += f' ref="{self.number(-30, 30)}"'
        if self.chance.random() < 0.1:
            extra = f'damping="{self.numbers(3, 0, 1)}" stiffness="{self.numbers(3, 0, 5)}"'
        # Two hinges of one body have axes far from parallel: else tiny differences become large ones.
        axis = [self.chance.uniform(-0.4, 0.4) for _ in range(3)]
        axis[len(self.joints) % 3] = 1.0
        joint = f'<joint name="{name}" axis="{" ".join(f"{part:.4g}" for part in axis)}" {extra}/>'
        return f'<frame pos="{self.numbers(3, -0.05, 0.05)}" {self.turn()}>{joint}</frame>' if self.chance.random() < 0.15 else joint

    def body(self, depth: int) -> str:
        name = f"b{len(self.bodies)}"
        self.bodies.append(name)
        content = ""
        hinges = self.chance.choice((0, 1, 1, 1, 2)) if depth else 0
        if depth and not self.joints:
            hinges = max(hinges, 1)
        content += "".join(self.joint(hinges == 1) for _ in range(hinges)) if depth else "<freejoint/>"
        content += "".join(self.geom() for _ in range(self.chance.randint(1, 2)))
        if self.chance.random() < 0.2:
            least = self.chance.uniform(0.01, 0.05)
            inertia = f"{least:.4g} {least * 1.4:.4g} {least * 1.2:.4g}"
            content += f'<inertial pos="{self.numbers(3, -0.05, 0.05)}" {self.turn()} mass="{self.number(0.2, 3)}" diaginertia="{inertia}"/>'
        while depth < self.DEPTH_MAX and len(self.bodies) < self.BODIES_MAX and (self.chance.random() < 0.6 or not (depth or self.joints)):
            inner = self.body(depth + 1)
            content += f'<frame pos="{self.numbers(3, -0.1, 0.1)}" {self.turn()}>{inner}</frame>' if self.chance.random() < 0.2 else inner
        place = self.numbers(3, -0.25, 0.25) if depth else f"0 0 {self.number(0.3, 2)}"
        extra = 'childclass="c"' if self.classes and self.chance.random() < 0.3 else ""
        if not depth and self.chance.random() < 0.1:
            extra += f' gravcomp="{self.number(0, 1)}"'
        return f'<body name="{name}" pos="{place}" {self.turn()} {extra}>{content}</body>'

    def actuator(self, index: int, joint: str) -> str:
        common = f'name="a{index}" joint="{joint}" ctrlrange="-1 1"'
        extra = self.some(
            f'gear="{self.number(0.5, 5)}"', f'forcerange="-{self.number(1, 10)} {self.number(1, 10)}"', f'armature="{self.number(0, 0.01)}"'
        )
        kp = self.number(5, 60)
        return self.chance.choice(
            (
                f"<motor {common} {extra}/>",
                f'<position {common} kp="{kp}" kv="{self.number(0.1, 3)}" {extra}/>',
                f'<position {common} kp="{kp}" dampratio="{self.number(0.3, 1.5)}" {extra}/>',
                f'<velocity {common} kv="{self.number(0.1, 3)}" {extra}/>',
                f'<general {common} gainprm="{kp}" biastype="affine" biasprm="0 -{kp} -{self.number(0.1, 2)}" {extra}/>',
            )
        )

    def sections(self) -> str:
        text = ""
        if len(self.joints) > 1 and self.chance.random() < 0.2:
            one, other = self.chance.sample(self.joints, 2)
            text += equality(f'<joint joint1="{one}" joint2="{other}" polycoef="{self.number(-0.1, 0.1)} {self.number(-1, 1)}"/>')
        if len(self.bodies) > 2 and self.chance.random() < 0.2:
            one, other = self.chance.sample(self.bodies, 2)
            text += f'<contact><exclude body1="{one}" body2="{other}"/></contact>'
        if len(self.joints) > 1 and self.chance.random() < 0.2:
            one, other = self.chance.sample(self.joints, 2)
            terms = f'<joint joint="{one}" coef="{self.number(-2, 2)}"/><joint joint="{other}" coef="{self.number(-2, 2)}"/>'
            text += f'<tendon><fixed range="-.3 .3" limited="true">{terms}</fixed></tendon>'
        return text

    def text(self) -> str:
        head = self.chance.choice(("", "", '<option solver="PGS"/>', '<option solver="CG"/>'))
        if self.classes:
            head += f'<default><joint damping="{self.number(0, 1)}"/><default class="c"><geom friction="{self.number(0.2, 1)}"/></default></default>'
        tree = self.body(0)
        driven = [joint for joint in self.joints if self.chance.random() < 0.8] or self.joints[:1]
        actuators = "".join(self.actuator(index, joint) for index, joint in enumerate(driven))
        friction = self.some(f'friction="{self.number(0.3, 1.2)}"')
        floor = f'<geom name="floor" type="plane" size="5 5 1" {friction}/>'
        world = f"<worldbody>{floor}{tree}</worldbody>"
        # A hinge that hits its limit hard stops within one step.
        wish = "<!--\nwant: either\ncone: pyramidal\ntolerance: 0.02\n-->\n"
        return f"{wish}<mujoco>{head}{world}{self.sections()}<actuator>{actuators}</actuator></mujoco>\n"
