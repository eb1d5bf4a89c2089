"""Films of episodes, drawn by MuJoCo."""

import shutil
import subprocess
from pathlib import Path

import mujoco

from .contract import TransferError, one_line

_WIDTH, _HEIGHT = 640, 480
# Pictures per second; more make a GIF large.
_RATE_HZ = 25.0


class Film:
    """Film of one episode, which the camera follows."""

    def __init__(self, path, robot):
        self.path, self.robot = Path(path), robot
        kind = self.path.suffix.lower()
        if kind not in (".gif", ".mp4"):
            raise TransferError(f"--film {path}: the name must end with .gif or .mp4")
        if kind == ".mp4" and not shutil.which("ffmpeg"):
            raise TransferError(f"--film {path}: an MP4 needs ffmpeg, which is not installed; name a .gif")
        if kind == ".gif":
            try:
                import PIL.Image  # noqa: F401: found now rather than at the end
            except ImportError as why:
                raise TransferError(f"--film {path}: a GIF needs Pillow; pip install pillow") from why
        if not self.path.parent.is_dir():
            raise TransferError(f"--film {path}: there is no folder `{self.path.parent}`")
        try:
            self.renderer = mujoco.Renderer(robot.model, _HEIGHT, _WIDTH)
        except Exception as why:  # noqa: BLE001: each library of OpenGL has errors of its own
            advice = "without a display, set MUJOCO_GL=egl, or MUJOCO_GL=osmesa with OSMesa installed"
            raise TransferError(f"--film cannot draw ({one_line(why)}); {advice}") from why
        self.camera = mujoco.MjvCamera()
        self.camera.type, self.camera.trackbodyid = mujoco.mjtCamera.mjCAMERA_TRACKING, robot.model.body(robot.contract.base_body).id
        self.camera.distance, self.camera.azimuth, self.camera.elevation = 3.5, 120.0, -15.0
        self.every = max(1, round(1.0 / (_RATE_HZ * robot.contract.control_step_s)))
        self.steps, self.pictures = 0, []

    def add(self):
        """Draws the present state, if a picture is due."""
        if self.steps % self.every == 0:
            self.renderer.update_scene(self.robot.data, self.camera)
            self.pictures.append(self.renderer.render())
        self.steps += 1

    def save(self):
        """Writes the file."""
        step_s = self.every * self.robot.contract.control_step_s
        try:
            if self.path.suffix.lower() == ".gif":
                from PIL import Image

                first, *others = (Image.fromarray(picture).quantize(128) for picture in self.pictures)
                first.save(self.path, save_all=True, append_images=others, duration=round(1000.0 * step_s), loop=0)
                return
            source = ["-f", "rawvideo", "-pix_fmt", "rgb24", "-s", f"{_WIDTH}x{_HEIGHT}", "-r", f"{1.0 / step_s}", "-i", "-"]
            command = ["ffmpeg", "-y", "-loglevel", "error", *source, "-pix_fmt", "yuv420p", str(self.path)]
            subprocess.run(command, input=b"".join(picture.tobytes() for picture in self.pictures), check=True)
        except (OSError, subprocess.CalledProcessError) as why:
            raise TransferError(f"--film {self.path}: cannot be written ({one_line(why)})") from why
