"""The merged tables of a campaign, read by other programs: the same numbers in all of them."""
import csv, json, pathlib, sys
import numpy, pyarrow.parquet, xarray

folder = pathlib.Path(sys.argv[1])
rows = list(csv.DictReader(open(folder / "points.csv")))
table = pyarrow.parquet.read_table(folder / "points.parquet")
assert table.num_rows == len(rows) == 3 * 2 * 2
numbers = ["point", "motion.frequency_hz", "air.density_kg_m3", "body.mass_kg", "success", "lift_over_weight", "power_watt", "end.mass_centre_n3_m"]
texts = ["dynamics.formulation", "verdict", "reason"]
assert sorted(table.column_names) == sorted(numbers + texts), table.column_names
for name in numbers:
    assert [float(r[name]) for r in rows] == [float(x) for x in table.column(name).to_pylist()], name
for name in texts:
    assert [r[name] for r in rows] == table.column(name).to_pylist(), name
units = json.loads(table.schema.metadata[b"units"])
assert units["power_watt"] == "W" and units["motion.frequency_hz"] == "Hz" and not set(texts) & set(units)

data = xarray.open_dataset(folder / "points.nc", engine="h5netcdf")
lift = data["lift_over_weight"]
assert lift.dims == ("motion.frequency_hz", "air.density_kg_m3", "sample"), lift.dims
assert lift.shape == (3, 2, 2) and lift.attrs["units"] == "1"
assert lift.values.ravel().tolist() == [float(r["lift_over_weight"]) for r in rows]
assert data["motion.frequency_hz"].values.tolist() == [190, 200, 210]
verdicts = [["green", "amber", "red"][int(v)] for v in data["verdict"].values.ravel()]
assert verdicts == [r["verdict"] for r in rows], verdicts
assert "body.mass_kg" in data.coords and data["body.mass_kg"].dims == ("sample",)
assert data["body.mass_kg"].values.tolist() == [float(r["body.mass_kg"]) for r in rows[:2]]
chosen = lift.sel({"motion.frequency_hz": 200, "air.density_kg_m3": 1.2}).values
assert numpy.all(numpy.isfinite(chosen))
assert data["dynamics.formulation"].values.tolist() == ["momentum", "quaternion"]
assert "units" not in data["dynamics.formulation"].attrs and data["dynamics.formulation"].attrs["long_name"]

# Texts as an axis: chosen by name, of several lengths and letters.
named = xarray.open_dataset(folder.parent / "texts" / "points.nc", engine="h5netcdf")
axis = named["wing.right.motion.phi.table.file"].values.tolist()
assert axis == ["a.csv", "Flügel schlag.csv"], axis
for k, name in enumerate(axis):
    found = named["end.wing_right_prescribed_phi_rad"].sel({"wing.right.motion.phi.table.file": name})
    assert found.values.tolist() == named["end.wing_right_prescribed_phi_rad"].values[k].tolist(), name
