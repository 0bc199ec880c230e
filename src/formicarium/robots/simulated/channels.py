"""Numbers that keep the noise of different sensors apart: each is added to the key of what is sensed."""

PROXIMITY = 1 << 20
CAMERA = 2 << 20
RADIO = 3 << 20
WHEELS = 4 << 20
GROUND = 5 << 20
AMBIENT = 6 << 20
