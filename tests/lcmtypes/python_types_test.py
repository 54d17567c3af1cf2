#!/usr/bin/env python3
"""What the C++ types encode, the generated Python types decode, and encode again to the same bytes.

usage: python_types_test.py BUILD_FOLDER
"""

import struct
import subprocess
import sys
import tempfile
from pathlib import Path

build = Path(sys.argv[1])
sys.path.insert(0, str(build / "share" / "python"))
import floornav  # noqa: E402

CHANNELS = {
    "BUMBLEBEE_CLOUD": floornav.depth_cloud_t, "GOAL": floornav.goal_t, "GRID_MAP": floornav.grid_map_t,
    "HEALTH": floornav.health_t, "KINECT_CLOUD": floornav.depth_cloud_t, "LOCAL_TO_GLOBAL": floornav.rigid_transform_t,
    "MAP_REQUEST": floornav.map_request_t, "PATH": floornav.path_t, "POSE": floornav.pose_t,
    "SURFELS": floornav.surfels_t, "TERRAIN_MAP": floornav.terrain_map_t,
}
ROUNDS = 3


def events(log):
    """(channel, bytes) of each event of an LCM log."""
    position = 0
    while position < len(log):
        sync, _, _, channel_size, size = struct.unpack_from(">Iqqii", log, position)
        assert sync == 0xEDA1DA01
        position += 28
        channel = log[position:position + channel_size].decode()
        position += channel_size
        yield channel, log[position:position + size]
        position += size


with tempfile.TemporaryDirectory() as folder:
    log = Path(folder) / "samples.lcm"
    subprocess.run([build / "bin" / "sample_publisher", f"file://{log}?mode=w", str(ROUNDS)], check=True)
    found = list(events(log.read_bytes()))

for channel, data in found:
    message = CHANNELS[channel].decode(data)
    assert message.utime > 1305031230000000, channel
    assert message.encode() == data, channel
assert sorted(channel for channel, _ in found) == sorted(ROUNDS * list(CHANNELS)), found
print(f"{len(found)} messages decoded")
