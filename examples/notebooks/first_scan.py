# %% [markdown]
# # A first scan
# From terrain to pictures: elevation, one scan of the real beam map, its arrays, xarray, and what changes with altitude
# and preset. Run it as a program, or cell by cell in an editor or in Jupyter (jupytext). It writes `land/` and its
# pictures into the current folder.

# %%
import numpy
from matplotlib import pyplot

import yars
from yars import plot

# %% [markdown]
# ## Terrain
# A made-up coast of two by two degrees. A folder of your own DTED, HGT or GeoTIFF files serves as well.

# %%
terrain = yars.Terrain(yars.Terrain.generate("land", south=37, west=-123, cells_lat=2, cells_lon=2))
print(f"{terrain.elevation(37.7, -122.2):.1f} m MSL at one position")
print(terrain.elevation(numpy.linspace(37.4, 38.2, 5), -122.2).round(1), "m MSL along a meridian")

# %% [markdown]
# ## A scan
# Position and heading in degrees, altitude in feet, range in nautical miles, as on the flight deck. The arguments are
# the options of the command `yars scan`. The antenna looks 4 degrees down.

# %%
pose = {"latitude_deg": 37.45, "longitude_deg": -122.3, "heading_deg": 5, "range_nm": 40, "elevation_deg": -4,
        "seed": 1}
radar = yars.Radar("standard")
scan = radar.scan(terrain, altitude_ft=12000, **pose)
print(scan)
for name in ("video", "power", "shadow", "height", "slant_range", "latitude"):
    array = getattr(scan, name)
    print(f"{name:12} {str(array.shape):12} {str(array.dtype):8} {scan.units[name] or 'no unit'}")

# %% [markdown]
# Arrays are not copied. They are bit for bit those of the command, and so is the hash.

# %%
print(f"hash {scan.hash:016x}; {100 * scan.shadow.mean():.1f} % of the samples are in shadow")

# %% [markdown]
# With names and coordinates, by xarray: mean height of the lit ground by azimuth.

# %%
try:
    data = scan.to_xarray(["power", "shadow", "height"])
    print(data["height"].where(~data["shadow"]).mean("sample")[::45].round(0))
except yars.MissingPart as missing:
    print(missing)

# %% [markdown]
# ## Pictures
# The pilot's picture, power before noise, shadow and where it lies. Ground range is in nautical miles; up is the middle
# of the scan.

# %%
figure, axes = pyplot.subplots(2, 2, figsize=(10.5, 7.6), constrained_layout=True)
for ax, quantity in zip(axes.flat, ("video", "power", "shadow")):
    plot.ppi(scan, ax=ax, quantity=quantity)
    ax.set_title(
        {"video": "video: what the pilot sees", "power": "power before noise", "shadow": "shadow (black)"}[quantity])
plot.map(terrain, scan, ax=axes[1, 1], bounds=(37.2, -123.0, 38.4, -121.5))
axes[1, 1].set_title("elevation, coast, outline of the scan")
figure.savefig("python_scan.png", dpi=80)

# %% [markdown]
# ## What altitude changes
# From a lower aircraft hills hide more of what lies behind them.

# %%
altitudes_ft = (5000, 10000, 20000, 40000)
figure, axes = pyplot.subplots(1, 4, figsize=(16, 3.5), constrained_layout=True)
for ax, altitude_ft in zip(axes, altitudes_ft):
    seen = radar.scan(terrain, altitude_ft=altitude_ft, **pose)
    plot.ppi(seen, ax=ax)
    ax.set_title(f"{altitude_ft:,} ft MSL: {100 * seen.shadow.mean():.1f} % in shadow")
figure.savefig("python_altitudes.png", dpi=70)

# %% [markdown]
# ## What the preset changes
# A preset trades speed for accuracy: `1996` is the method of the report that YARS follows, `reference` the yardstick.
# The presets have different numbers of samples; the ranges are the same.
# `1996` lights only what lies within the beam's height.

# %%
figure, axes = pyplot.subplots(1, 4, figsize=(16, 3.5), constrained_layout=True)
for ax, preset in zip(axes, ("1996", "draft", "standard", "reference")):
    seen = yars.Radar(preset).scan(terrain, altitude_ft=12000, **pose)
    plot.ppi(seen, ax=ax)
    ax.set_title(f"{preset}: {seen.video.shape[0]} sweeps of {seen.video.shape[1]}")
figure.savefig("python_presets.png", dpi=70)
