"""What holds for all tests."""

from hypothesis import settings

# A first call loads or compiles machine code, and other tests run beside: how long an example takes tells nothing.
settings.register_profile("no deadline", deadline=None)
settings.load_profile("no deadline")
