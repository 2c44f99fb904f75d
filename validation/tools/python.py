"""Restarts a script with a Python that has what it needs, when the one on PATH has not.  Standard library only."""
import importlib.util
import os
import subprocess
import sys

NEEDED = ("numpy", "netCDF4", "matplotlib")
CANDIDATES = ("/usr/bin/python3", "/usr/local/bin/python3")
RESTARTED = "CLEAVE_VALIDATION_RESTARTED"  # guards against going round in circles


def _other():
    """Another interpreter that can import what is needed, or None."""
    probe = "import " + ", ".join(NEEDED)
    for candidate in CANDIDATES:
        if os.path.exists(candidate) and os.path.realpath(candidate) != os.path.realpath(sys.executable):
            if subprocess.run([candidate, "-c", probe], capture_output=True).returncode == 0:
                return candidate
    return None


def ensure(script):
    """Returns if numpy, netCDF4 and matplotlib are there; else runs `script` with a Python that has them, or ends."""
    missing = [name for name in NEEDED if importlib.util.find_spec(name) is None]
    if not missing:
        return
    other = None if os.environ.get(RESTARTED) else _other()
    if other is None:
        sys.exit(f"{script}: this Python ({sys.executable}) lacks {', '.join(missing)} and no other one has them.\n"
                 "Install them (Debian: python3-numpy python3-netcdf4 python3-matplotlib) and run again.")
    os.environ[RESTARTED] = "1"
    os.execv(other, [other, os.path.abspath(script), *sys.argv[1:]])
