"""Controllers that fail, each in its own way, at their sixth answer; the first is their identity."""

import sys

BAD = """
import os, sys, time
import formicarium.trial.onboard as onboard
from formicarium.trial.controller import main
usual, answers = onboard.send, []
def send(line, content):
    answers.append(content)
    if len(answers) == 6:  # the identity is the first
        {deed}
    usual(line, content)
import formicarium.trial.controller as controller
controller.send = send
main(int(sys.argv[1]), int(sys.argv[2]))
"""
DEEDS = {
    "dies": "os._exit(3)",
    "hangs": "time.sleep(60)",
    "babbles": "content = b'hello'",
    "raves": "content = b'\\xff' * len(content)",
}


def commands_of(programs):
    """Return identity -> command line: those of ``programs`` misbehave, all others are the package's own."""

    def command(identity):
        if identity in programs:
            return [sys.executable, "-c", BAD.format(deed=programs[identity])]
        return [sys.executable, "-m", "formicarium.trial.controller"]

    return command
