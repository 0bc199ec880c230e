"""``formicarium campaign VERB``: studies of many cells and many runs."""

from cyclopts import App

from formicarium.commands.campaign.adopt import adopt
from formicarium.commands.campaign.clean import clean
from formicarium.commands.campaign.collect import collect
from formicarium.commands.campaign.compare import compare
from formicarium.commands.campaign.pack import pack
from formicarium.commands.campaign.plan import plan
from formicarium.commands.campaign.run import run
from formicarium.commands.campaign.status import status

HELP = """Studies: a table of factors, each cell repeated with seeds of its own, in one folder.

    formicarium campaign plan study.toml       what would be run
    formicarium campaign run study.toml        run it, or go on with it
    formicarium campaign status study.toml     how far it is, from any terminal
    formicarium campaign collect study.toml    one table of all runs, and figures
    formicarium campaign compare A B           do two campaigns differ?
"""

campaign = App(name="campaign", help=HELP, help_format="plaintext", help_flags=["--help", "-h"])
for verb in (plan, run, status, collect, compare, pack, adopt, clean):
    campaign.command(verb)
