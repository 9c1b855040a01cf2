"""An arm of seven hinges with a parallel gripper, made of capsules and boxes: a robot file of one's own."""

from __future__ import annotations

LINKS = (
    (0.15, "0 0 1"),
    (0.15, "0 1 0"),
    (0.2, "0 0 1"),
    (0.2, "0 1 0"),
    (0.2, "0 0 1"),
    (0.2, "0 1 0"),
    (0.08, "0 0 1"),
)
"""Height above the last joint [m] and axis of every joint; all are in line at zero."""

FINGER = """
<body name="{name}" pos="0 {y} 0.08">
  <joint name="{name}" type="slide" axis="0 {sign} 0" range="0 0.04" armature="0.1" damping="20"/>
  <geom name="{name}_pad" type="box" size="0.01 0.006 0.03" pos="0 0 0.03" mass="0.05" condim="4"
    friction="1.5 0.01 0.0001"/>
</body>"""


def own_arm(*, gripper: str = "position", torque: str = 'forcerange="-80 80"', fingers: bool = True) -> str:
    """The MJCF.

    Args:
        gripper: the element of its actuator; none where empty.
        torque: attribute that limits the torques of the arm.
        fingers: whether it has any.
    """
    hand = '<geom name="palm" type="box" size="0.03 0.08 0.03" pos="0 0 0.05" mass="0.5"/>'
    if fingers:
        hand += FINGER.format(name="left", y=-0.006, sign=-1) + FINGER.format(name="right", y=0.006, sign=1)
    body = hand
    for number, (height, axis) in reversed(list(enumerate(LINKS, start=1))):
        ahead = LINKS[number][0] if number < len(LINKS) else 0.04
        link = f'<geom type="capsule" size="0.04" fromto="0 0 0.03 0 0 {max(ahead - 0.05, 0.04)}" mass="1.5"/>'
        ranged = "-2.9 2.9" if axis == "0 0 1" else "-2.2 2.2"
        joint = f'<joint name="j{number}" axis="{axis}" range="{ranged}" armature="0.1" damping="1"/>'
        body = f'<body name="link{number}" pos="0 0 {height}">{joint}{link}{body}</body>'
    arm = "".join(
        f'<position name="a{n}" joint="j{n}" kp="500" ctrlrange="-3 3" {torque}/>' for n in range(1, len(LINKS) + 1)
    )
    grip = f'<{gripper} name="grip" tendon="both" kp="2000" ctrlrange="0 0.04" forcerange="-60 60"/>' if gripper else ""
    tied = """<tendon><fixed name="both"><joint joint="left" coef="0.5"/><joint joint="right" coef="0.5"/></fixed>
    </tendon>
    <equality><joint joint1="left" joint2="right" solref="0.005 1"/></equality>"""
    excluded = "".join(f'<exclude body1="link{n}" body2="link{n + 1}"/>' for n in range(1, len(LINKS)))
    return f"""<mujoco model="own"><compiler angle="radian"/>
    <worldbody><body name="base"><geom type="cylinder" size="0.06 0.05" pos="0 0 0.05" mass="3"/>{body}</body>
    </worldbody>
    {tied if fingers else ""}
    <contact><exclude body1="base" body2="link1"/>{excluded}</contact>
    <actuator>{arm}{grip if fingers else ""}</actuator></mujoco>"""


def jaw_arm() -> str:
    """The MJCF of five hinges and one jaw that turns towards a fixed one."""
    limit = 'range="-2.6 2.6" armature="0.03" damping="0.5" frictionloss="0.1"'
    return f"""<mujoco model="jaw"><compiler angle="radian"/>
    <worldbody><body name="base"><geom type="cylinder" size="0.05 0.04" pos="0 0 0.04" mass="2"/>
     <body name="turn" pos="0 0 0.09"><joint name="turn" axis="0 0 1" {limit}/>
      <geom type="sphere" size="0.03" mass="0.4"/>
      <body name="upper" pos="0 0 0.04"><joint name="lift" axis="0 1 0" {limit}/>
       <geom type="capsule" size="0.02" fromto="0 0 0.04 0 0 0.22" mass="0.4"/>
       <body name="fore" pos="0 0 0.25"><joint name="bend" axis="0 1 0" {limit}/>
        <geom type="capsule" size="0.02" fromto="0 0 0.04 0 0 0.19" mass="0.3"/>
        <body name="wrist" pos="0 0 0.22"><joint name="flex" axis="0 1 0" {limit}/>
         <geom type="sphere" size="0.02" mass="0.1"/>
         <body name="palm" pos="0 0 0.05"><joint name="roll" axis="0 0 1" {limit}/>
          <geom name="palm" type="box" size="0.015 0.03 0.01" pos="0 0 0.01" mass="0.1"/>
          <geom name="fixed" type="box" size="0.01 0.004 0.03" pos="0 -0.01 0.05" mass="0.05" condim="4"/>
          <body name="jaw" pos="0 0.02 0.02">
           <joint name="jaw" axis="1 0 0" range="-1.7 0.2" armature="0.01" damping="0.5"/>
           <geom name="moving" type="box" size="0.01 0.004 0.03" pos="0 -0.01 0.03" mass="0.05" condim="4"/>
    </body></body></body></body></body></body></body></worldbody>
    <contact><exclude body1="base" body2="turn"/><exclude body1="turn" body2="upper"/>
     <exclude body1="upper" body2="fore"/><exclude body1="fore" body2="wrist"/>
     <exclude body1="wrist" body2="palm"/><exclude body1="palm" body2="jaw"/></contact>
    <actuator>
     {"".join(f'<motor joint="{name}" ctrlrange="-15 15"/>' for name in ("turn", "lift", "bend", "flex", "roll"))}
     <position name="jaw" joint="jaw" kp="50" ctrlrange="-1.7 0.2" forcerange="-4 4"/>
    </actuator></mujoco>"""
