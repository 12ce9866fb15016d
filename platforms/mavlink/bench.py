"""How long a vehicle waits between two missions, on loopback, with a simulated vehicle in another process:

    .environment/bin/python bench.py

From the order to start to the vehicle's first word that it flies: the mission is uploaded, downloaded, compared, noted
and begun. Times are the median, nine in ten, and the longest, of 30 missions.
"""

import os
import statistics
import subprocess
import sys
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from tests.test_process import FOLDER, Adapter, free_port  # noqa: E402


def mission(items):
    ways = [
        {"item": "move", "arguments": [10 if n % 2 else -10, 10 if n < items / 2 else -10], "named": {}}
        for n in range(items)
    ]
    return {
        "name": "bench",
        "language": "mission",
        "body": {"items": [{"item": "altitude", "arguments": [20], "named": {}}, *ways]},
    }


def measure(adapter, items):
    times = []
    for n in range(30):
        request = f"{items}-{n}"
        adapter.reports.clear()
        begun = time.perf_counter()
        adapter.order(kind="start", request=request, vehicle="mav-1", plan=mission(items), timeout=30)
        adapter.until(lambda r: r.get("request") == request and r["kind"] in ("taken", "failed"))
        times.append(1000 * (time.perf_counter() - begun))
        assert adapter.end_of(request)["kind"] == "done"
    times.sort()
    median = statistics.median(times)
    print(f"{items:4} items: median {median:.1f} ms, 90 % {times[26]:.1f} ms, longest {times[-1]:.1f} ms")


def main():
    port = free_port()
    vehicle = subprocess.Popen(
        [sys.executable, "-B", "-m", "sim", "--to", f"127.0.0.1:{port}", "--time", "40", "--armed", "copter"],
        stdin=subprocess.PIPE,
        env=dict(os.environ, PYTHONPATH=FOLDER),
    )
    adapter = Adapter("--udp", str(port))
    try:
        adapter.greet()
        adapter.until_ready()
        for items in (1, 5, 20):
            measure(adapter, items)
    finally:
        adapter.close()
        vehicle.kill()
        vehicle.wait(5)


if __name__ == "__main__":
    main()
