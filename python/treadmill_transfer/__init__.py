"""Plays an exported policy of Treadmill's velocity task in MuJoCo, by the contract in its ONNX file alone.

Modules:
  contract    what the ONNX file says of the robot, the observation and the task
  robot       MuJoCo's model with the contract's servos
  ground      height field in place of the model's floor
  controller  observations, history and actions, as on the robot
  commands    schedules of commands and pushes
  errors      how well commands are followed
  play        episodes
  motion      policies that imitate a motion
  trace       comparison with a trace of `treadmill eval --trace`
  cli         command line
"""
