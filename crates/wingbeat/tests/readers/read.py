"""Opens a result directory with the readers that users have and compares every number.

Called by tests/exports.rs as `python read.py DIR`; exits with an error at the first difference.
"""

import csv
import json
import sys
from pathlib import Path

import h5py
import numpy as np
import polars
import pyarrow.parquet as parquet
import vtk
import xarray
from vtk.util.numpy_support import vtk_to_numpy

result = Path(sys.argv[1])


def history():
    with open(result / "history.csv") as file:
        rows = list(csv.reader(file))
    return {n: np.array([float(r[k]) for r in rows[1:]]) for k, n in enumerate(rows[0])}


def polydata(path):
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(str(path))
    reader.Update()
    assert reader.GetErrorCode() == 0, path
    return reader.GetOutput()


def same(a, b, what):
    assert a.shape == b.shape and (a == b).all(), what


def points(data):
    return vtk_to_numpy(data.GetPoints().GetData()) if data.GetNumberOfPoints() else np.zeros((0, 3))


def corners(data):
    lists = data.GetPolys() if data.GetNumberOfPolys() else data.GetVerts()
    return vtk_to_numpy(lists.GetConnectivityArray())


def numbers(attributes):
    arrays = [attributes.GetArray(k) for k in range(attributes.GetNumberOfArrays())]
    return {a.GetName(): vtk_to_numpy(a) for a in arrays}


def cells(data):
    # Numbers of panels stand at cells, those of particles at points.
    return {**numbers(data.GetCellData()), **numbers(data.GetPointData())}


def check_hdf5(columns, frames):
    with h5py.File(result / "flight.h5") as file:
        assert file.attrs["layout_version"] == 5
        assert file["case_toml"][()].decode() == (result / "case.toml").read_text()
        summary = json.loads(file["summary_json"][()])
        assert summary["steps"] == len(columns["time_s"]) - 1
        assert sorted(file["history"]) == sorted(columns)
        for name, values in columns.items():
            same(file["history"][name][:], values, name)
            assert file["history"][name].dtype.kind == ("i" if name.endswith("_count") else "f"), name
            assert file["history"][name].attrs["units"] and file["history"][name].attrs["frame"]
        assert file["history/body_x_m"].attrs["units"] == b"m"
        assert file["history/momentum_n1_kg_m_per_s"].attrs["units"] == b"kg m s-1"
        for stem, series in frames.items():
            group = file["frames"][stem]
            point = group["point_offsets"][:]
            cell = point if stem == "particles" else group["cell_offsets"][:]
            for k, data in enumerate(series):
                part = slice(cell[k], cell[k + 1])
                same(group["points_m"][point[k] : point[k + 1]], points(data), stem)
                if stem != "particles":
                    same(group["quads"][part].ravel(), corners(data), stem)
                for name, values in cells(data).items():
                    same(group[name][part], values, name)
    table = xarray.open_dataset(result / "flight.h5", group="history", engine="h5netcdf")
    assert dict(table.sizes) == {"time_s": len(columns["time_s"])}
    assert table["body_x_m"].attrs["units"] == "m"
    same(table["time_s"].values, columns["time_s"], "time_s")
    middle = columns["time_s"][len(columns["time_s"]) // 2]
    assert float(table["body_z_m"].sel(time_s=middle)) == columns["body_z_m"][len(columns["time_s"]) // 2]


def check_parquet(columns):
    table = parquet.read_table(result / "history.parquet")
    assert table.column_names == list(columns)
    for name, values in columns.items():
        same(table[name].to_numpy(), values, name)
        assert str(table[name].type) == ("int64" if name.endswith("_count") else "double"), name
    assert json.loads(table.schema.metadata[b"units"])["time_s"] == "s"


def check_csv(columns):
    # Types are inferred from the first rows, which are full of zeros.
    table = polars.read_csv(result / "history.csv", infer_schema_length=2)
    assert table.columns == list(columns)
    for name, values in columns.items():
        same(table[name].to_numpy(), values, name)
        wanted = polars.Int64 if name.endswith("_count") else polars.Float64
        assert table[name].dtype == wanted, (name, table[name].dtype)


def check_vtkhdf(times, frames):
    for stem, series in frames.items():
        reader = vtk.vtkHDFReader()
        reader.SetFileName(str(result / f"{stem}.vtkhdf"))
        reader.UpdateInformation()
        assert reader.GetNumberOfSteps() == len(series)
        for k, expected in enumerate(series):
            reader.SetStep(k)
            reader.Update()
            data = reader.GetOutput()
            assert reader.GetTimeValue() == times[k]
            same(points(data), points(expected), stem)
            assert data.GetNumberOfCells() == expected.GetNumberOfCells()
            if data.GetNumberOfCells():
                same(corners(data), corners(expected), stem)
                for name, values in cells(expected).items():
                    same(cells(data)[name], values, name)


columns = history()
steps = sorted(int(p.stem.split("_")[1]) for p in (result / "frames").glob("surfaces_*.vtp"))
frames = {
    stem: [polydata(result / "frames" / f"{stem}_{k:06d}.vtp") for k in steps]
    for stem in ("surfaces", "wakes", "particles")
}
assert frames["wakes"][-1].GetNumberOfCells() > 0
last = frames["particles"][-1]
assert last.GetNumberOfVerts() == last.GetNumberOfPoints() > 0
assert cells(last)["strength_m3_per_s"].shape == (last.GetNumberOfPoints(), 3)
pvd = (result / "flight.pvd").read_text()
assert all(f"frames/{stem}_{k:06d}.vtp" in pvd for k in steps for stem in frames)
times = [columns["time_s"][k] for k in steps]
for data, k in zip(frames["surfaces"], steps):
    assert np.isfinite(points(data)).all() and "pressure_jump_pascal" in cells(data)
check_hdf5(columns, frames)
check_parquet(columns)
check_csv(columns)
check_vtkhdf(times, frames)
print(f"{len(columns)} columns, {len(columns['time_s'])} rows, {len(steps)} frames: all equal")
