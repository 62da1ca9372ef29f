# %% [markdown]
# # A patch map and its labels
# A made-up town on made-up terrain, mapped finely: which object, which material, where shadow and layover are, where
# each pixel lies, and the same place from four sides.
# It writes `land/`, `town.flt` and its pictures into the current folder.

# %%
import numpy
from matplotlib import patches, pyplot
from matplotlib.colors import to_rgb

import yars
from yars import plot

# %% [markdown]
# ## Terrain and scene
# The scene is an OpenFlight file; one of your own serves as well.

# %%
CENTRE = (37.5, -122.5)
terrain = yars.Terrain(yars.Terrain.generate("land_of_the_town", south=37, west=-123, cells_lat=1, cells_lon=1,
                                             edge="cut"))
town = yars.Scene.generate("town.flt", kind="town", triangles=20000, seed=1, origin=(*CENTRE, 20))
scene = yars.Scene(town, terrain)
print(scene)
print(scene.objects[["name", "height_m", "length_m", "width_m", "heading_deg"]][2:6])

# %% [markdown]
# ## One map
# The aircraft maps the town from 8 NM, 40 degrees off its ground track:
# straight ahead a synthetic aperture sees nothing.

# %%
radar = yars.Radar("standard", map_size=200)
RANGE_NM = 8


def pose_from(bearing_deg):
    """Arguments of a patch map of the town, with the line of sight along a true bearing."""
    back = numpy.radians(bearing_deg + 180)
    return {"latitude_deg": CENTRE[0] + RANGE_NM / 60 * numpy.cos(back),
            "longitude_deg": CENTRE[1] + RANGE_NM / 60 * numpy.sin(back) / numpy.cos(numpy.radians(CENTRE[0])),
            "altitude_ft": 14000, "heading_deg": (bearing_deg + 40) % 360, "speed_kt": 480,
            "target_latitude_deg": CENTRE[0], "target_longitude_deg": CENTRE[1], "window_nm": 0.67, "looks": 3,
            "seed": 1}


one = radar.patch(terrain, scene, **pose_from(45))
print(one, {name: round(one.facts[name], 2) for name in ("slant_range_m", "grazing_angle", "resolution_m")})

# %% [markdown]
# ## Labels
# - **object**: which object of the scene gave the strongest return of the pixel; -1 is the ground.
# - **material**: its code in DFAD, such as 1 metal, 3 masonry, 9 concrete, 12 trees.
# - **shadow**: no surface that the radar sees returns there.
# - **layover**: two or more separate surfaces have that slant range, such as a roof and the street in front of it.

# %%
MATERIALS = {0: "land", 1: "metal", 2: "part metal", 3: "masonry", 4: "composition", 5: "earthworks", 6: "water",
             7: "sand", 8: "rock", 9: "concrete", 10: "soil", 11: "marsh", 12: "trees", 13: "snow", 14: "asphalt"}
COLORS = ["#e8e0c8", "#c81e1e", "#f08232", "#823ca0", "#e6c81e", "#8c6e46", "#1e5abe", "#f0dca0", "#787878", "#505050",
          "#c8a878", "#5a9696", "#1e8c46", "#f0f0ff", "#282828"]
labelled = one.object[one.object >= 0]
print(f"shadow {one.shadow.mean():.1%}, layover {one.layover.mean():.1%}, {numpy.unique(labelled).size} objects return")
for code, pixels in zip(*numpy.unique(one.material[~one.shadow], return_counts=True)):
    print(f"  {MATERIALS[code]:12} {pixels / one.material.size:.1%} of the map")

# %% [markdown]
# ## Boxes
# `patches()` maps many places in one call and gives boxes of objects, too:
# corners as (column, row) from the upper left corner.

# %%
order = numpy.zeros(1, yars.PATCH_ORDER)
for name, value in pose_from(45).items():
    if name != "seed":
        order[name.removesuffix("_deg")] = value
boxes = radar.patches(terrain, order, scene)["boxes"]
tall = [box for box in boxes if scene.objects[box["object"]]["height_m"] > 8 and box["pixels"] > 0]
print(f"{len(boxes)} boxes, {len(tall)} of objects taller than 8 m that return; the first:", tall[0])

# %%
figure, axes = pyplot.subplots(2, 3, figsize=(12.5, 8), constrained_layout=True)
plot.patch(one, ax=axes[0, 0])
axes[0, 0].set_title("video, boxes of what exceeds 8 m")
edge_m = one.facts["window_m"]
for box in tall:
    corners = (box["corners"] / radar.map_size - 0.5) * (edge_m, -edge_m)
    axes[0, 0].add_patch(patches.Polygon(corners, fill=False, edgecolor="#ffb400", linewidth=0.8))
plot.patch(one, ax=axes[0, 1], quantity="object")
axes[0, 1].set_title("object (a colour each; white: ground)")
codes = numpy.unique(one.material[~one.shadow])
extent = (-edge_m / 2, edge_m / 2, -edge_m / 2, edge_m / 2)
picture = numpy.array([to_rgb(color) for color in COLORS])[one.material]
picture[one.shadow] = 1
axes[0, 2].imshow(picture, extent=extent)
axes[0, 2].legend([patches.Patch(color=COLORS[code]) for code in codes], [MATERIALS[code] for code in codes],
                  fontsize=8, loc="upper left", framealpha=1)
axes[0, 2].set_title("material (white: shadow)")
axes[0, 2].set_xlabel("across the line of sight [m]")
axes[0, 2].set_ylabel("along the line of sight [m]")
for ax, quantity in zip(axes[1], ("shadow", "layover")):
    plot.patch(one, ax=ax, quantity=quantity)
    ax.set_title(f"{quantity} (black)")

# %% [markdown]
# ## Geocoding
# Each pixel has latitude and longitude, so the picture can be drawn north up, with the boxes of other maps or of a GIS.

# %%
ax = axes[1, 2]
ax.pcolormesh(one.longitude, one.latitude, one.video, cmap="gray", shading="nearest", rasterized=True)
ax.plot(scene.objects["longitude"][2:], scene.objects["latitude"][2:], ".", color="#ffb400", markersize=2)
ax.set_aspect(1 / numpy.cos(numpy.radians(CENTRE[0])))
ax.ticklabel_format(useOffset=False)
ax.locator_params(nbins=4)
ax.set_xlabel("longitude [deg]")
ax.set_ylabel("latitude [deg]")
ax.set_title("north up; dots: centres of the objects")
figure.savefig("python_labels.png", dpi=75)

# %% [markdown]
# ## The same place from four sides
# Shadows fall away from the radar, walls that face it are bright. Up is the line of sight.

# %%
figure, axes = pyplot.subplots(1, 4, figsize=(15, 4.2), constrained_layout=True)
for ax, bearing_deg in zip(axes, (0, 90, 180, 270)):
    side = radar.patch(terrain, scene, **pose_from(bearing_deg))
    plot.patch(side, ax=ax)
    ax.set_title(f"looking {'north east south west'.split()[bearing_deg // 90]}: {side.shadow.mean():.0%} shadow")
figure.savefig("python_sides.png", dpi=70)
