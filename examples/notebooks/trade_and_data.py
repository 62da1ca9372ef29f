# %% [markdown]
# # A trade, and a data set
# How much time a preset costs and what it gains; then 64 labelled chips, read back, and statistics of the theatre. It
# writes `chips.yaml`, `chips/` and its pictures into the current folder.

# %%
import pathlib
import subprocess
import sys

import numpy
from matplotlib import pyplot

import yars
from yars import plot

# %% [markdown]
# ## The trade of presets
# Time against error, over two scans of the built-in hills: a marker is the mean, a bar ends at the worse scan. The
# times are those of this computer.

# %%
SCANS = ["37.3,-122.4,15000,30,10", "37.3,-122.4,15000,30,40"]
rows = yars.trade(presets="all", scene=SCANS, repeat=2)
for point in rows["points"]:
    print(f"{point['point']:10} {point['scan_ms']['mean']:8.2f} ms {point['shadow_percent']['mean']:6.2f} % of "
          "the shadow wrong")
figure, ax = pyplot.subplots(figsize=(7.5, 5), constrained_layout=True)
plot.trade_front(rows, ax=ax, error="shadow_percent")
ax.set_title("presets: time against error of the shadow")
figure.savefig("python_trade.png", dpi=80)

# %% [markdown]
# ## A data set
# A specification says how many chips and from which distributions. The program is `python3 -m yars.dataset`.

# %%
pathlib.Path("chips.yaml").write_text("""
count: 64
seed: 3
chip: {size: 64, window_nm: 0.67, arrays: [video, power, shadow, object, material]}
terrain: {generate: {south: 37, west: -123, edge: cut}}
scenes:
  - {generate: town, triangles: 20000, at: [37.5, -122.3, 20]}
  - {generate: airfield, triangles: 20000, seed: 2, at: [37.8, -122.6, 110]}
targets:
  - {scenes: all, weight: 3, north_m: {uniform: [-200, 200]}, east_m: {uniform: [-200, 200]}}
  - {area: [37.2, -122.9, 37.9, -122.1], on: any}
geometry: {range_nm: {log_uniform: [5, 18]}, altitude_ft: {uniform: [8000, 25000]}}
output: {block: 16}
""")
subprocess.run([sys.executable, "-m", "yars.dataset", "chips.yaml", "--out", "chips", "--workers", "1"], check=True)

# %% [markdown]
# ## Reading it back

# %%
from yars.dataset import Dataset  # noqa: E402  where it is needed first

data = Dataset("chips")
print(len(data), "chips of", data.arrays, "classes", data.classes)
chip = data[5]
print(chip["video"].shape, len(chip["boxes"]), "boxes,", chip["parameters"]["order"]["altitude_ft"], "ft")

# %% [markdown]
# Each picture: video in gray, shadow in blue, objects of the scenes in red. All of chip 29 lies behind a mountain.

# %%
margins = {"left": 0.005, "right": 0.995, "bottom": 0.005, "top": 0.965, "wspace": 0.05, "hspace": 0.2}
figure, axes = pyplot.subplots(4, 8, figsize=(12, 6.6), gridspec_kw=margins)
for item, ax in enumerate(axes.flat):
    chip = data[item]
    picture = numpy.repeat(chip["video"][..., None] / 255.0, 3, axis=2)
    picture[chip["shadow"] > 0] = 0.5 * picture[chip["shadow"] > 0] + (0.0, 0.1, 0.5)
    picture[chip["object"] >= 0] = 0.6 * picture[chip["object"] >= 0] + (0.4, 0.05, 0.0)
    ax.imshow(picture.clip(0, 1), interpolation="nearest")
    ax.set_title(f"{item}: {len(chip['boxes'])} boxes", fontsize=9)
    ax.set_xticks([])
    ax.set_yticks([])
figure.savefig("python_chips.png", dpi=66)

# %% [markdown]
# ## Statistics of the theatre
# Power by material, over all pixels of all chips that are not in shadow; and how the objects lie to the line of sight.

# %%
MATERIALS = {0: "land", 1: "metal", 2: "part metal", 3: "masonry", 4: "composition", 6: "water", 9: "concrete",
             10: "soil", 12: "trees", 14: "asphalt"}
chips = [data[item] for item in range(len(data))]
power = numpy.concatenate([chip["power"].ravel() for chip in chips])
material = numpy.concatenate([chip["material"].ravel() for chip in chips])
good = (numpy.concatenate([chip["shadow"].ravel() for chip in chips]) == 0) & (power > 0)
aspect_deg = numpy.concatenate([chip["boxes"]["aspect_deg"] for chip in chips])

figure, axes = pyplot.subplots(1, 2, figsize=(12, 4.6), constrained_layout=True)
edges_db = numpy.arange(-60, 21, 1.0)
for code, name in MATERIALS.items():
    of_code = good & (material == code)
    if of_code.sum() > 500:
        power_db = 10 * numpy.log10(power[of_code])
        axes[0].hist(power_db, edges_db, density=True, histtype="step", linewidth=1.5,
                     label=f"{name} ({of_code.sum():,})")
        print(f"{name:12} median {numpy.median(power_db):6.1f} dB, {of_code.sum()} pixels")
axes[0].set_xlabel("power: gamma before speckle and noise [dB]")
axes[0].set_ylabel("density [1/dB]")
axes[0].set_title("power by material (pixels)")
axes[0].legend(fontsize=9)
axes[1].hist(aspect_deg, numpy.arange(0, 181, 10), color="#1e5abe")
axes[1].set_xlim(0, 180)
axes[1].set_xticks(range(0, 181, 30))
axes[1].set_xlabel("aspect: line of sight minus longer side [deg]")
axes[1].set_ylabel("objects")
axes[1].set_title(f"aspect of {aspect_deg.size:,} objects in {len(data)} chips")
figure.savefig("python_statistics.png", dpi=75)
