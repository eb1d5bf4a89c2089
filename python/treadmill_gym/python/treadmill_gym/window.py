"""The window of `render_mode="human"`, by pygame."""

import os
import time

from gymnasium.error import DependencyNotInstalled, Error

#: What SDL falls back to where it finds no display: they draw nowhere.
UNSEEN = {"dummy", "offscreen"}

#: Where drawing takes longer than a step, so many steps are left out between two pictures at most.
LEFT_OUT_MAX = 4


class WindowClosed(Error):
    """The user closed the window."""


class Window:
    """A window that is opened with the first picture, and shows pictures in real time."""

    def __init__(self, width, height, fps):
        # Said now, and not in the middle of an episode.
        try:
            import pygame
        except ImportError as why:
            raise DependencyNotInstalled(
                'render_mode="human" needs pygame: pip install "treadmill-gym[human]" or pygame-ce; "rgb_array" does without'
            ) from why
        self._pygame = pygame
        self._size, self._step_s = (width, height), 1 / fps
        self._surface = None
        self._due_s, self._left_out = 0.0, 0

    def is_due(self):
        """Whether a step is to be shown: all are where there is time, which goes on as it does for the body."""
        now_s = time.perf_counter()
        # What was lost in a pause is not caught up with.
        self._due_s = max(self._due_s, now_s - LEFT_OUT_MAX * self._step_s) + self._step_s
        is_late = now_s > self._due_s
        self._left_out = self._left_out + 1 if is_late and self._left_out < LEFT_OUT_MAX else 0
        return self._left_out == 0

    def show(self, picture):
        """Shows `[height, width, 3]`, and waits until the step is over."""
        pygame = self._pygame
        if self._surface is None:
            self._open()
        # pygame's first axis is the column.
        pygame.surfarray.blit_array(self._surface, picture.swapaxes(0, 1))
        pygame.display.flip()
        time.sleep(max(0.0, self._due_s - time.perf_counter()))
        if any(event.type == pygame.QUIT for event in pygame.event.get()):
            self.close()
            raise WindowClosed("the window was closed")

    def _open(self):
        pygame = self._pygame
        try:
            pygame.display.init()
            wanted = os.environ.get("SDL_VIDEODRIVER") or os.environ.get("SDL_VIDEO_DRIVER")
            if pygame.display.get_driver() in UNSEEN and not wanted:
                raise pygame.error("there is no display")
            surface = pygame.display.set_mode(self._size)
        except pygame.error as why:
            pygame.display.quit()
            raise Error(
                f'render_mode="human" needs a display, and no window could be opened: {why}; use "rgb_array" without one, or '
                "a virtual display such as xvfb-run"
            ) from why
        pygame.display.set_caption("Treadmill")
        self._surface = surface

    def close(self):
        """Closes it; the next picture would open it again."""
        if self._surface is not None:
            self._surface = None
            self._pygame.display.quit()
