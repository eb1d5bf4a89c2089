"""Ctrl-C and SIGTERM: the first requests a stop, the second ends the process."""

import signal

SIGNALS = (signal.SIGINT, signal.SIGTERM)


def request_stop(stopping):
    """Sets the event `stopping` at the first signal, and restores the signals' default actions for the second."""

    def receive(*_):
        # First of all, as the event may be locked by the code that the signal interrupts.
        for number in SIGNALS:
            signal.signal(number, signal.SIG_DFL)
        stopping.set()

    for number in SIGNALS:
        signal.signal(number, receive)
