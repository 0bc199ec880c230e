import pytest

from formicarium.systems import registry


@pytest.fixture(params=registry.names())
def name(request) -> str:
    return request.param


@pytest.fixture
def system(name) -> registry.System:
    return registry.resolve(name)
