"""``formicarium doctor``: what is installed, what works, and what to do about what does not."""


def doctor() -> int:
    """Check this installation: versions, compiler, cache, processes, extras; every trouble with its remedy.

    Exit code 1 if something needed does not work; missing extras are no trouble.
    """
    from formicarium.commands.examining import examine

    trouble = 0
    for finding in examine():
        mark = "ok  " if finding.well else "--  " if finding.optional else "BAD "
        print(
            f"{mark} {finding.what}" + (f"\n      {finding.remedy}" if not finding.well and finding.remedy else ""),
            flush=True,
        )
        trouble += not finding.well and not finding.optional
    print("\nEverything that is needed works." if not trouble else f"\n{trouble} of these must be mended.")
    return int(trouble > 0)
