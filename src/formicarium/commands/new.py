"""``formicarium new NAME``: a working system of one's own, laid out in a folder."""


def new(name: str, /) -> int:
    """Lay out a working system of your own in a new folder NAME: a small swarm to change at will.

    It runs straight from that folder, is watched, replayed, swept and tested
    like every other system, and its README says which file is for what.

    Examples:

        formicarium new my-swarm
        cd my-swarm
        formicarium run my-swarm

    Parameters
    ----------
    name
        Name of the system: small letters, digits and hyphens.
    """
    from formicarium.commands.laying_out import lay_out

    folder, module = lay_out(name)
    print(
        f"{folder}/ is laid out. Next:\n\n"
        f"    cd {folder}\n"
        f"    formicarium run {name}          one run, with pictures\n"
        f"    formicarium watch {name}        the same on a live page\n"
        f"    python -m pytest{' ' * max(1, len(name) - 1)}          the contracts of every system\n\n"
        f"What a robot does is in {folder}/{module}/behaviour.py; README.md says the rest."
    )
    return 0
