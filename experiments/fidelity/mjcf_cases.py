"""MJCF files of one feature each, for `mjcf_diff.py`."""

# A base with an arm of two hinges and a ball on a third one, above the ground.
ROBOT = """<mujoco>{head}
  <worldbody>
    <geom name="floor" type="plane" size="5 5 1" {floor}/>
    <body name="base" pos="0 0 {height}" {turn} {base}>
      <freejoint/>
      <geom name="trunk" size=".1" {trunk}/>
      <body name="upper" pos="0 0 -.2" {upper}>
        <joint name="j" axis="0 1 0" {joint}/>
        <geom name="arm" type="capsule" fromto="0 0 0 0 0 -.3" size=".04" {arm}/>
        {within}
      </body>
      <body name="side" pos=".2 0 0">
        <joint name="k" axis="1 0 0"/>
        <geom name="ball" size=".05" pos="0 .1 0" {ball}/>
      </body>
      {more}
    </body>
  </worldbody>
  {sections}
  <actuator>{actuator}</actuator>
</mujoco>
"""
MOTOR = '<motor name="m" joint="j" gear="20" ctrlrange="-1 1"/>'
EMPTY = dict.fromkeys(("head", "floor", "turn", "base", "trunk", "upper", "joint", "arm", "within", "ball", "more", "sections"), "")
# The ball lies on the ground.
LYING = {"height": "0.145", "turn": 'euler="-70 0 20"'}


def model(want: str = "equal", names: str = "", cone: str = "", **slots: str) -> str:
    """Returns a model with these slots filled, and what is wanted of it as first comment."""
    lines = [f"want: {want}"] + [f"names: {names}"] * bool(names) + [f"cone: {cone}"] * bool(cone)
    filled = {**EMPTY, "height": "2", "actuator": MOTOR, **slots}
    return "<!--\n" + "\n".join(lines) + "\n-->\n" + ROBOT.format(**filled)


def equality(content: str) -> str:
    return f"<equality>{content}</equality>"


def floor_pair(attributes: str, **slots: str) -> str:
    pair = f'<contact><pair geom1="floor" geom2="ball" {attributes}/></contact>'
    return model(cone="pyramidal", sections=pair, **LYING, **slots)


# A hand of two bodies with defaults of its own.
HAND = """<mujoco model="hand">
  <default><geom size=".03" density="700"/><joint damping="0.3"/><default class="f"><geom friction="0.4"/></default></default>
  <asset><mesh name="t" vertex="0 0 0 .1 0 0 0 .1 0 0 0 .1"/></asset>
  <worldbody>
    <body name="palm" pos=".1 0 0">
      <geom name="p"/>
      <frame name="f" pos="0 0 .05"><geom type="mesh" mesh="t" contype="0" conaffinity="0"/></frame>
      <body name="finger" pos="0 0 -.1"><joint name="fj" axis="0 1 0" range="-60 60"/><geom class="f"/></body>
    </body>
  </worldbody>
  <contact><exclude body1="palm" body2="finger"/></contact>
  <actuator><motor name="fm" joint="fj" gear="2" ctrlrange="-1 1"/></actuator>
</mujoco>
"""


def features() -> dict[str, str]:
    """Returns files that show one feature each, by name."""
    refused = "refused"
    mimic = '<joint joint1="k" joint2="j" polycoef="0.1 -0.5" solref="0.01 0.7" solimp="0.8 0.9 0.01"/>'
    rod = '<connect body1="upper" body2="side" anchor="0 0 -.3"/>'
    servo = 'name="m" joint="j" ctrlrange="-1 1"'
    tetrahedron = 'vertex="0 0 0 .2 0 0 0 .2 0 0 0 .2"'
    pgs = '<option solver="PGS"/>'
    cases = {
        # Joints.
        "joint_plain": model(),
        "joint_degrees": model(joint='range="-60 30"'),
        "joint_radians": model(head='<compiler angle="radian"/>', joint='range="-1 0.5"'),
        "joint_unlimited": model(joint='range="-60 30" limited="false"'),
        "joint_zero_range": model(joint='range="0 0"'),
        "joint_ref": model(joint='ref="20" range="-60 60"'),
        "joint_spring": model(joint='stiffness="20" springref="30" damping="0.5"'),
        "joint_spring_powers": model(joint='stiffness="20 30 40" springref="20"'),
        "joint_damping_powers": model(joint='damping="1 2 3"'),
        "joint_springdamper_motor": model(
            joint='springdamper=".05 .7" damping="0.3"', actuator=f'<motor {servo} gear="5" damping="0.02" armature="0.001"/>'
        ),
        "joint_springdamper": model(joint='springdamper=".05 .7" armature="0.01"'),
        "joint_armature": model(joint='armature="0.1"'),
        "joint_friction": model(joint='frictionloss="0.5"'),
        "joint_friction_softness": model(joint='frictionloss="0.5" solreffriction="0.05 0.5" solimpfriction="0.8 0.9"'),
        "joint_limit_softness": model(joint='range="-3 3" solreflimit="-500 -20" solimplimit="0.7 0.9 0.01 0.4 3"'),
        "joint_margin": model(joint='range="-60 3" margin="0.1"'),
        "joint_margin_both": model(joint='range="-3 3" margin="0.2"'),
        "joint_margin_both_pgs": model(head=pgs, joint='range="-3 3" margin="0.2" frictionloss="0.5"'),
        "joint_torque_range": model(joint='actuatorfrcrange="-5 5"'),
        "joint_slide": model("either", within='<body><joint type="slide"/><geom size=".03"/></body>'),
        "joint_ball": model("either", within='<body><joint type="ball"/><geom size=".03"/></body>'),
        "joint_damping_negative": model(refused, "damping", joint='damping="-1"'),
        "joint_no_attribute": model(refused, "wings", joint='wings="2"'),
        "joints_two": model(within='<body pos="0 0 -.3"><joint axis="1 0 0"/><joint axis="0 1 0" pos=".01 0 0"/><geom size=".04"/></body>'),
        # Frames.
        "frame_joint": model(within='<body pos="0 0 -.3"><frame pos="0 .1 0" euler="30 20 10"><joint pos=".02 0 .1"/><geom size=".04"/></frame></body>'),
        "frame_inertial": model(
            within='<body pos="0 0 -.3"><joint/><frame pos="0 0 .1" euler="30 20 10"><inertial pos=".02 0 .1" mass="1" '
            'diaginertia=".01 .02 .015"/></frame></body>'
        ),
        "frame_nested": model(more='<frame pos="0 .1 0"><frame euler="0 0 30"><body pos=".1 0 0"><joint/><geom size=".04"/></body></frame></frame>'),
        "frame_childclass": model(
            head='<default><default class="c"><geom size=".06"/></default></default>', more='<frame childclass="c"><geom pos="0 0 .2"/></frame>'
        ),
        # Composed models.
        "replicate": model(
            more='<replicate count="3" offset="0 .15 0" euler="0 0 20" sep="-"><body name="q" pos=".3 0 0"><joint name="q"/><geom size=".04"/></body></replicate>',
            sections='<contact><exclude body1="base" body2="q"/></contact>',
            actuator=MOTOR + '<motor name="qm" joint="q" gear="3" ctrlrange="-1 1"/>',
        ),
        "replicate_nested": model(
            more='<replicate count="2" offset="0 .15 0"><replicate count="2" offset=".15 0 0" sep="_"><body name="q" pos=".3 0 0">'
            '<joint name="q"/><geom size=".04"/></body></replicate></replicate>',
            sections='<tendon><fixed name="t" range="-.05 .05" solreflimit=".05 1"><joint joint="q" coef="1"/></fixed></tendon>',
        ),
        "replicate_axes": model(
            more='<replicate count="10" offset=".1 .2 .3" euler="10 20 30"><body name="q" pos=".3 0 0"><joint name="q"/><geom size=".04" '
            'contype="0" conaffinity="0"/></body></replicate>',
            actuator=MOTOR + '<motor name="qm" joint="q" ctrlrange="-1 1"/>',
        ),
        "replicate_equality": model(
            more='<replicate count="3" offset="0 .15 0"><body name="q" pos=".3 0 0"><joint name="q"/><joint name="p" axis="1 0 0"/>'
            '<geom size=".04" pos="0 0 .05"/></body></replicate>',
            sections=equality('<joint joint1="q" joint2="p"/><joint joint1="q" joint2="j"/><connect body1="upper" body2="q" anchor="0 0 0"/>'),
        ),
        "replicate_geoms": model(within='<replicate count="12" euler="0 0 30"><geom size=".02" pos=".1 0 0"/></replicate>'),
        "attach_itself": model(more='<body pos="-.2 0 0"><attach body="upper" prefix="x_"/></body>'),
        "attach_main": model(
            head='<default><geom friction="0.7"/><joint damping="0.4"/></default><asset><model name="hand" file="_hand.xml"/></asset>',
            joint='class="main"',
            within='<attach model="hand" body="finger" prefix="l_"/>',
        ),
        "attach_model": model(
            head='<default><geom friction="0.7"/><joint armature="0.02"/></default><asset><model name="hand" file="_hand.xml"/></asset>',
            within='<frame pos="0 .1 -.3" euler="0 0 30"><attach model="hand" body="palm" prefix="l_"/></frame>',
            more='<frame pos="0 -.1 -.3"><attach model="hand" body="palm" prefix="r_"/></frame>',
        ),
        "attach_world": model(
            head='<asset><model file="_hand.xml"/></asset>', within='<attach model="hand" prefix="l_"/>', floor='friction="0.3"'
        ),
        "attach_frame": model(head='<asset><model name="hand" file="_hand.xml"/></asset>', within='<attach model="hand" frame="f" prefix="l_"/>'),
        "attach_unknown": model(refused, "ghost", within='<attach model="ghost" body="palm" prefix="l_"/>'),
        # Masses.
        "mass_given": model(ball='mass="0.3"'),
        "mass_density": model(ball='density="300"'),
        "mass_zero": model(arm='mass="0"', ball='mass="0.3"', within='<geom size=".05" pos="0 0 -.1"/>'),
        "mass_inertial_full": model(
            within='<body pos="0 0 -.3"><joint/><inertial pos=".01 0 0" mass="1" fullinertia=".02 .03 .025 .001 .002 .003"/></body>'
        ),
        "mass_inertial_turned": model(
            within='<body pos="0 0 -.3"><joint/><inertial pos=".01 0 0" quat="1 .2 .3 .4" mass="1" diaginertia=".02 .03 .025"/></body>'
        ),
        "mass_total": model(head='<compiler settotalmass="12"/>'),
        "mass_bounds": model(head='<compiler boundmass="0.5" boundinertia="0.01"/>'),
        "mass_groups": model(head='<compiler inertiagrouprange="0 1"/>', within='<geom group="2" size=".1"/>'),
        "mass_balance": model(
            head='<compiler balanceinertia="true"/>',
            within='<body pos="0 0 -.3"><joint/><inertial pos="0 0 0" mass="1" diaginertia=".01 .01 .03"/></body>',
        ),
        "mass_impossible": model("refused", within='<body><joint/><inertial pos="0 0 0" mass="1" diaginertia=".01 .01 .03"/></body>'),
        "mass_shell": model(arm='shellinertia="true" density="5"', ball='shellinertia="true" mass="0.2"'),
        "mass_shell_box": model(within='<geom type="box" size=".05 .04 .03" euler="20 30 40" shellinertia="true" density="8"/>'),
        "mass_shell_cylinder": model(within='<geom type="cylinder" fromto="0 0 0 .1 .1 .1" size=".03" shellinertia="true" density="8"/>'),
        "mass_shell_ellipsoid": model("either", within='<geom type="ellipsoid" size=".05 .04 .03" shellinertia="true"/>'),
        "mass_shell_mesh": model(
            head=f'<asset><mesh name="t" {tetrahedron} inertia="shell"/></asset>', within='<geom type="mesh" mesh="t" density="9"/>'
        ),
        # Shapes.
        "shape_box": model(within='<geom type="box" size=".05 .04 .03" euler="20 30 40" pos="0 .1 0"/>'),
        "shape_cylinder": model(within='<geom type="cylinder" fromto="0 0 0 .1 .1 .1" size=".03"/>'),
        "shape_ellipsoid": model(within='<geom type="ellipsoid" size=".05 .04 .03"/>'),
        "shape_axes": model(within='<geom type="box" size=".05 .04 .03" xyaxes="1 1 0 -1 1 0"/>'),
        "shape_zaxis": model(within='<geom type="capsule" size=".03 .1" zaxis="1 2 3"/>'),
        "shape_mesh": model(head=f'<asset><mesh name="t" {tetrahedron}/></asset>', within='<geom type="mesh" mesh="t" pos="0 0 -.4"/>'),
        "shape_mesh_scaled": model(
            head=f'<asset><mesh name="t" {tetrahedron} scale="1 2 .5" refpos=".01 0 0" inertia="convex"/></asset>',
            within='<geom type="mesh" mesh="t"/>',
        ),
        # Contacts.
        "contact_ground": model(cone="pyramidal", **LYING),
        "contact_friction": model(cone="pyramidal", ball='friction="0.3"', floor='friction="0.2"', **LYING),
        "contact_priority": model(cone="pyramidal", ball='friction="0.3" priority="1" solref="0.05 1"', **LYING),
        "contact_softness": model(cone="pyramidal", ball='solref="0.05 0.5" solimp="0.5 0.9 0.01" solmix="3"', **LYING),
        "contact_margin": model(cone="pyramidal", ball='margin="0.005"', **LYING),
        "contact_frictionless": model(ball='condim="1"', floor='condim="1"', **LYING),
        "contact_bits": model(cone="pyramidal", ball='contype="2" conaffinity="2"', arm='contype="4" conaffinity="2"', **LYING),
        "contact_exclude": model(sections='<contact><exclude body1="upper" body2="side"/></contact>'),
        "pair_one_friction": floor_pair('friction="0.3" margin="0.002"'),
        "pair_two_frictions": floor_pair('friction="0.3 0.9"'),
        "pair_two_frictions_pgs": floor_pair('friction="0.3 0.9"', head=pgs),
        "pair_softness": floor_pair('solref="-3000 -100" solimp="0.8 0.95 0.002"'),
        "pair_unknown": model(refused, "wing", sections='<contact><pair geom1="floor" geom2="wing"/></contact>'),
        # Actuators.
        "motor_force_range": model(actuator=f'<motor {servo} gear="20" forcerange="-.3 .3"/>'),
        "motor_without_range": model(actuator='<motor name="m" joint="j" gear="3"/>'),
        "motor_rotor": model(actuator=f'<motor {servo} gear="5" armature="0.001" damping="0.002 0.001 0.001"/>'),
        "motors_two": model(actuator=f'{MOTOR}<motor name="n" joint="j" gear="2" ctrlrange="-1 1"/>'),
        "servo_position": model(actuator=f'<position {servo} kp="50" kv="2"/>'),
        "servo_gear": model(actuator=f'<position {servo} kp="5" kv="0.2" gear="3"/>'),
        "servo_ratio": model(actuator=f'<position {servo} kp="50" dampratio="0.8" armature="0.01"/>'),
        "servo_inherit": model(joint='range="-60 30"', actuator='<position name="m" joint="j" kp="50" kv="2" inheritrange="0.9"/>'),
        "servo_saturates": model(actuator=f'<position {servo} kp="500" kv="5" forcerange="-2 2"/>'),
        "servo_velocity": model(actuator=f'<velocity {servo} kv="3"/>'),
        "servo_general": model(actuator=f'<general {servo} gainprm="40" biastype="affine" biasprm="1 -40 -2"/>'),
        "servo_filtered": model("either", actuator=f'<position {servo} kp="50" timeconst="0.1"/>'),
        "servo_delayed": model("either", actuator=f'<position {servo} kp="50" delay="0.01" nsample="6"/>'),
        "servo_damper": model("either", actuator='<damper name="m" joint="j" kv="1" ctrlrange="0 1"/>'),
        # Defaults.
        "class_nested": model(
            head='<default><joint damping="0.5"/><default class="a"><joint armature="0.1"/><default class="b"><joint frictionloss="0.2"/>'
            "</default></default></default>",
            joint='class="b"',
        ),
        "class_childclass": model(head='<default><default class="a"><joint damping="0.7"/></default></default>', upper='childclass="a"'),
        "class_actuators": model(
            head='<default><position kp="40" kv="1" ctrlrange="-.5 .5"/></default>', actuator='<position name="m" joint="j"/>'
        ),
        "class_equality": model(head='<default><equality solref="0.05 2"/></default>', sections=equality('<joint joint1="k" joint2="j"/>')),
        "class_missing": model(refused, "ghost", joint='class="ghost"'),
        # Equalities and tendons.
        "equality_joint": model(sections=equality(mimic)),
        "equality_joint_pgs": model(head=pgs, sections=equality(mimic)),
        "equality_joint_alone": model(sections=equality('<joint joint1="k" polycoef="0.3"/>')),
        "equality_joint_ref": model(joint='ref="20"', sections=equality('<joint joint1="k" joint2="j" polycoef="0.02 -0.5"/>')),
        "equality_joint_square": model(refused, "polycoef", sections=equality('<joint joint1="k" joint2="j" polycoef="0 1 0.5"/>')),
        "equality_connect": model(sections=equality(rod)),
        "equality_connect_pgs": model(head=pgs, sections=equality(rod)),
        "equality_connect_soft": model(
            sections=equality('<connect body1="upper" body2="side" anchor=".1 0 -.3" solref=".05 .5" solimp=".5 .9 .05 .4 3"/>')
        ),
        "equality_connect_sites": model(
            within='<site name="s" pos="0 0 -.3"/>', more='<site name="t" pos="0.01 0 -.49"/>', sections=equality('<connect site1="s" site2="t"/>')
        ),
        "equality_connect_world": model(refused, "world", sections=equality('<connect body1="upper" anchor="0 0 -.3"/>')),
        "equality_weld": model("either", sections=equality('<weld body1="upper" body2="side"/>')),
        "equality_inactive": model(sections=equality('<joint joint1="k" joint2="j" active="false"/>')),
        "tendon_limited": model(
            sections='<tendon><fixed range="-.05 .05" limited="true" solreflimit=".05 1"><joint joint="j" coef="1"/><joint joint="k" coef="-2"/></fixed></tendon>'
        ),
        "tendon_spring": model("either", sections='<tendon><fixed stiffness="5"><joint joint="j" coef="1"/></fixed></tendon>'),
        "tendon_spatial": model(
            "either",
            within='<site name="s"/>',
            more='<site name="t"/>',
            sections='<tendon><spatial stiffness="5"><site site="s"/><site site="t"/></spatial></tendon>',
        ),
        # Options.
        "option_gravity": model(head='<option gravity="1 2 -5"/>'),
        "option_wind": model(refused, "wind", head='<option wind="1 0 0"/>'),
        "option_fluid": model(refused, "density", head='<option density="1.2"/>'),
        "option_flag": model("either", head='<option><flag gravity="disable"/></option>'),
        "option_euler": model(head='<compiler eulerseq="ZYX"/>', turn='euler="10 20 30"'),
        "body_gravcomp": model(upper='gravcomp="0.5"', base='gravcomp="1.2"'),
        "body_mocap": model("either", more='<body mocap="true"/>'),
        "keyframes": model(
            sections='<keyframe><key name="bent" qpos="0 0 1 1 0 0 0 .5 -.5"/><key name="fast" qvel="1 2 3 1 2 3 1 2"/></keyframe>'
        ),
        "ground_hfield": model(
            head='<asset><hfield name="h" nrow="2" ncol="3" size="5 5 .2 .1" elevation="0 1 0 1 0 1"/></asset>',
            more="",
            floor='contype="0" conaffinity="0"',
            sections='<worldbody><geom type="hfield" hfield="h" pos="0 0 -1"/></worldbody>',
        ),
    }
    return cases


def parts() -> dict[str, str]:
    """Returns files that the cases name."""
    return {"_hand.xml": HAND}
