"""``formicarium check SYSTEM``: the contracts of every system, held against one."""


def check(system: str, /) -> int:
    """Hold the contracts that every system keeps against one: repeatable, honest, watchable, compiled as written.

    It takes a minute or two. Exit code 1 if one is broken.

    Examples:

        formicarium check my-swarm

    Parameters
    ----------
    system
        Name of the system; list them with: formicarium systems
    """
    from formicarium.commands.known import find_system
    from formicarium.contracts.checking import check_system

    find_system(system)

    def told(sentence: str, said: str) -> None:
        mark = "kept   " if not said else "skipped" if said.startswith("-: ") else "BROKEN "
        print(f"{mark} {sentence}" + (f"\n        {said.removeprefix('-: ')}" if said else ""), flush=True)

    found = check_system(system, told)
    return int(any(said and not said.startswith("-: ") for said in found.values()))
