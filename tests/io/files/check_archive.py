"""An archive as netCDF4 for Python reads it, and its checksums as the xz format computes them."""

import lzma
import struct

import netCDF4
import numpy

from sample_files import sample_files


def crc64(data):
    """CRC-64/XZ as liblzma stores it: a stream of one block, whose check ends before the index."""
    stream = lzma.compress(data, check=lzma.CHECK_CRC64)
    index_size = (struct.unpack("<I", stream[-8:-4])[0] + 1) * 4
    end = len(stream) - 12 - index_size
    return struct.unpack("<Q", stream[end - 8:end])[0]


assert crc64(b"123456789") == 0x995DC9BBDF1939FA

with sample_files() as folder:
    path = folder + "/archive.nc"
    with netCDF4.Dataset(path) as archive:
        archive.set_auto_mask(False)
        assert archive.data_model == "NETCDF3_64BIT_DATA"
        assert archive.archive_format == "Cleave archive 1"
        assert archive.deck == "&run\n  end_time = 1d-4\n/\n"
        assert archive.step == 2**63 - 1 and archive.time == 0.1 and numpy.isnan(archive.not_reached)
        names = list(archive.variables)
        assert names == ["header_checksum", "plate:x", "plate:bonds", "special", "none", "no_ids", "one"]
        numpy.testing.assert_array_equal(archive["plate:x"][:], [[1, 2, 3], [4, 5, 6.5]])
        numpy.testing.assert_array_equal(archive["plate:bonds"][:], [[1, 2], [2, 3], [-(2**63), -1]])
        assert archive["plate:x"].units == "m"
        assert archive["plate:x"].long_name == "current position"
        assert archive["none"].shape == (0, 3) and archive["no_ids"].shape == (0,)
        for name in names[1:]:
            values = archive[name][:]
            little_endian = values.astype(values.dtype.newbyteorder("<")).tobytes()
            checksum = crc64(little_endian) if little_endian else 0
            assert archive[name].checksum == f"crc64:{checksum:016x}", name
        header_checksum = int(archive["header_checksum"][...]) % 2**64
        data_bytes = 8 + sum(archive[name][:].nbytes for name in names[1:])

    with open(path, "rb") as stream:
        contents = stream.read()
    assert crc64(contents[:len(contents) - data_bytes]) == header_checksum
