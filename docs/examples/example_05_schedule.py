"""The shortest schedule of five tasks for a swarm that must stay connected, proven; needs the extra "scheduling"."""

import formicarium

tasks = {
    "tasks": [
        {"name": "well", "x": 3, "y": 1, "duration": 2},
        {"name": "mill", "x": -2, "y": 4, "duration": 1},
        {"name": "barn", "x": 1, "y": -3, "duration": 1},
        {"name": "gate", "x": -4, "y": -1, "duration": 2},
        {"name": "yard", "x": 0, "y": 2, "duration": 1},
    ],
}
answer = formicarium.schedule(tasks, robots=9, objective="time")
print("least time:", answer.value, "proven" if answer.proven else "not proven")
