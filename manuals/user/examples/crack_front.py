"""Prints when a bond first broke beyond each tenth of the plate: crack_front.py NAME.events.nc"""
import sys

import netCDF4
import numpy

with netCDF4.Dataset(sys.argv[1]) as events:
    time, x = events["time"][:], events["x"][:]
for front in numpy.linspace(x.min(), x.max(), 11):
    print(f"x >= {front:10.4g}: first break at {time[x >= front].min():.4g}")
