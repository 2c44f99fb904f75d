"""A record table as netCDF4 and the csv module of Python read it."""

import csv
import math

import netCDF4
import numpy

from sample_files import sample_files

RECORDS = 5000


def expected(record):
    balance = math.nan if record == 7 else math.ldexp(1.0 / (record + 1), -(record // 10))
    return [10 * record, record / 3.0, balance]


with sample_files() as folder:
    with netCDF4.Dataset(folder + "/history.nc") as table:
        table.set_auto_mask(False)
        assert table.data_model == "NETCDF3_64BIT_DATA"
        assert table.units == "mm-ms-g-MPa"
        assert table.dimensions["record"].isunlimited()
        assert list(table.variables) == ["step", "time", "balance"]
        assert table["step"].dtype == numpy.int64 and table["time"].dtype == numpy.float64
        assert [v.units for v in table.variables.values()] == ["1", "ms", "mJ"]
        assert table["time"].long_name == "time at the end of the step"
        columns = [v[:] for v in table.variables.values()]
    assert all(len(column) == RECORDS for column in columns)
    for record in range(RECORDS):
        found = [column[record] for column in columns]
        numpy.testing.assert_array_equal(found, expected(record))  # takes nan as equal to nan

    with open(folder + "/history.csv", newline="", encoding="utf-8") as stream:
        rows = list(csv.reader(stream))
    assert rows[0] == ["step [1]", "time [ms]", "balance [mJ]"], rows[0]
    assert len(rows) == RECORDS + 1
    for record, row in enumerate(rows[1:]):
        assert row[0] == str(10 * record), row  # no decimals
        values = [float(text) for text in row]
        numpy.testing.assert_array_equal(values, [column[record] for column in columns])
        # the shortest text: Python's own is the shortest, too
        if record != 7:
            assert all(len(text) <= len(repr(value)) for text, value in zip(row, values, strict=True))
