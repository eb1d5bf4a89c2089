"""Pygame window of `render_mode="human"`."""

import os
import time

from gymnasium.error import DependencyNotInstalled, Error

#: SDL's fallback drivers without a display, which draw nothing.
HEADLESS_DRIVERS = {"dummy", "offscreen"}

#: Most steps skipped between two pictures when drawing is slower than real time.
SKIPPED_MAX = 4


class WindowClosed(Error):
    """The user closed the window."""


class Window:
    """Window that opens with the first picture and shows pictures in real time."""

    def __init__(self, width, height, fps):
        # Fail at construction, not in the middle of an episode.
        try:
            import pygame
        except ImportError as why:
            raise DependencyNotInstalled(
                'render_mode="human" needs pygame: pip install "treadmill-gym[human]" or pygame-ce; "rgb_array" does not'
            ) from why
        self._pygame = pygame
        self._size, self._step_s = (width, height), 1 / fps
        self._surface = None
        self._due_s, self._skipped = 0.0, 0

    def is_due(self):
        """Whether to show this step: steps are skipped when the window lags behind real time."""
        now_s = time.perf_counter()
        # After a pause, do not catch up.
        self._due_s = max(self._due_s, now_s - SKIPPED_MAX * self._step_s) + self._step_s
        is_late = now_s > self._due_s
        self._skipped = self._skipped + 1 if is_late and self._skipped < SKIPPED_MAX else 0
        return self._skipped == 0

    def show(self, picture):
        """Shows a picture `[height, width, 3]` and waits until the step is over."""
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
            requested = os.environ.get("SDL_VIDEODRIVER") or os.environ.get("SDL_VIDEO_DRIVER")
            if pygame.display.get_driver() in HEADLESS_DRIVERS and not requested:
                raise pygame.error("there is no display")
            surface = pygame.display.set_mode(self._size)
        except pygame.error as why:
            pygame.display.quit()
            raise Error(
                f'render_mode="human" needs a display, but no window could be opened: {why}; use "rgb_array" or '
                "a virtual display such as xvfb-run"
            ) from why
        pygame.display.set_caption("Treadmill")
        self._surface = surface

    def close(self):
        """Closes the window; another picture would reopen it."""
        if self._surface is not None:
            self._surface = None
            self._pygame.display.quit()
