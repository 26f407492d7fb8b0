# SPDX-License-Identifier: Apache-2.0
"""Uses the add-on as a user of Blender does, from its installation on.

  blender -b --factory-startup --python add_on.py -- ADD_ON LIGHTWELL FOLDER

FOLDER is empty; what a browser is told to open is written into FOLDER/opened by the program that BROWSER names. Blender does not
end with an error when a script fails, so the last line says that all went well.
"""

import json
import os
import subprocess
import sys
import traceback
import urllib.request

import bpy
import numpy

ADD_ON, LIGHTWELL, FOLDER = sys.argv[sys.argv.index("--") + 1 :]
PACK = os.path.join(FOLDER, "room.lw.glb")


def info(pack):
    return json.loads(subprocess.run([LIGHTWELL, "info", "--json", pack], check=True, stdout=subprocess.PIPE).stdout)


def document(pack):
    """The JSON of a pack."""
    with open(pack, "rb") as file:
        head = file.read(20)
        return json.loads(file.read(int.from_bytes(head[12:16], "little")))


def noted_sky(pack):
    return document(pack)["scenes"][0].get("extras", {}).get("lightwell", {})


def expect_refusal(operator, words):
    try:
        operator()
    except RuntimeError as error:
        assert words in str(error), error
    else:
        raise AssertionError(f"not refused: {words}")


def irradiance(pack, normal):
    """What the pack says arrives from this side, in glTF's axes, two metres above the ground."""
    points = os.path.join(FOLDER, "points.csv")
    with open(points, "w") as file:
        file.write("x,y,z,nx,ny,nz\n0,2.5,0," + ",".join(map(str, normal)) + "\n")
    command = [LIGHTWELL, "probe", pack, "--points", points, "--integrator", "ivg", "--json", "--quiet"]
    found = subprocess.run(command, check=True, stdout=subprocess.PIPE).stdout
    return sum(json.loads(found)["points"][0]["rgb"])


def install():
    assert bpy.ops.preferences.addon_install(filepath=ADD_ON) == {"FINISHED"}
    assert bpy.ops.preferences.addon_enable(module="lightwell") == {"FINISHED"}


def make_scene():
    """A cube on a ground, under a sun."""
    bpy.ops.mesh.primitive_plane_add(size=8, location=(0, 0, -1))
    bpy.data.objects.remove(bpy.data.objects["Light"])
    bpy.ops.object.light_add(type="SUN", rotation=(0.5, 0.3, 0))
    bpy.context.object.name = "Sun"
    bpy.context.scene.lightwell.pack = PACK
    bpy.context.scene.lightwell.options = "--quiet --grid 4"


def background():
    return next(node for node in bpy.context.scene.world.node_tree.nodes if node.type == "BACKGROUND")


def surround_by(kind):
    nodes, links = bpy.context.scene.world.node_tree.nodes, bpy.context.scene.world.node_tree.links
    node = nodes.new(kind)
    links.new(node.outputs["Color"], background().inputs["Color"])
    return node


def test_says_what_is_missing():
    expect_refusal(bpy.ops.lightwell.bake, "there is no program")
    expect_refusal(bpy.ops.lightwell.show, "bake first")
    bpy.context.preferences.addons["lightwell"].preferences.program = LIGHTWELL


def test_bakes_scene_and_world():
    background().inputs["Color"].default_value = (0.5, 0.25, 1, 1)
    background().inputs["Strength"].default_value = 2
    assert bpy.ops.lightwell.bake() == {"FINISHED"}
    subprocess.run([LIGHTWELL, "verify", "--quiet", PACK], check=True, stdout=subprocess.DEVNULL)
    described = info(PACK)
    assert described["grids"] and described["lamps"][0]["kind"] == "sun", described
    assert sorted(mesh["name"] for mesh in document(PACK)["meshes"]) == ["Cube", "Plane"]
    assert noted_sky(PACK)["skyRadiance"] == [1, 0.5, 2]


def test_says_why_a_bake_failed():
    settings = bpy.context.scene.lightwell
    options, settings.options = settings.options, "--grid sixty"
    expect_refusal(bpy.ops.lightwell.bake, "--grid: sixty: is neither auto nor a whole number")
    settings.options = options


def test_takes_the_sky_of_the_world():
    sky = surround_by("ShaderNodeTexSky")
    sky.sky_type = "PREETHAM"
    sky.turbidity = 4.5
    assert bpy.ops.lightwell.bake() == {"FINISHED"}
    assert noted_sky(PACK) == {"skyTurbidity": 4.5}, noted_sky(PACK)
    bpy.data.objects["Sun"].hide_set(True)
    expect_refusal(bpy.ops.lightwell.bake, "the scene no sun")
    bpy.data.objects["Sun"].hide_set(False)
    bpy.context.scene.world.node_tree.nodes.remove(sky)


def test_takes_the_picture_of_the_world():
    """A picture that is bright where Blender's x axis points, which is glTF's too."""
    picture = bpy.data.images.new("sky", 64, 32, float_buffer=True)
    pixels = numpy.zeros((32, 64, 4), dtype=numpy.float32)
    pixels[10:22, 28:36] = 5
    picture.pixels.foreach_set(pixels.ravel())
    node = surround_by("ShaderNodeTexEnvironment")
    node.image = picture
    bpy.data.objects["Sun"].hide_set(True)
    assert bpy.ops.lightwell.bake() == {"FINISHED"}
    sides = {axis: irradiance(PACK, axis) for axis in ((1, 0, 0), (-1, 0, 0), (0, 0, 1), (0, 0, -1))}
    bright = sides.pop((1, 0, 0))
    assert bright > 2 * max(sides.values()), (bright, sides)
    bpy.data.objects["Sun"].hide_set(False)
    bpy.context.scene.world.node_tree.nodes.remove(node)


def test_shows_the_pack():
    assert bpy.ops.lightwell.show() == {"FINISHED"}
    assert bpy.ops.lightwell.show() == {"FINISHED"}
    with open(os.path.join(FOLDER, "opened")) as file:
        first, second = file.read().split()
    assert first == second, "one server shows a pack"
    with urllib.request.urlopen(first + "packs.json") as answer:
        assert [pack["name"] for pack in json.load(answer)["packs"]] == ["room.lw.glb"]
    assert bpy.ops.preferences.addon_disable(module="lightwell") == {"FINISHED"}
    try:
        urllib.request.urlopen(first + "packs.json")
    except OSError:
        return
    raise AssertionError("the server goes with the add-on")


try:
    install()
    make_scene()
    for name, test in list(globals().items()):
        if name.startswith("test_"):
            print(name, flush=True)
            test()
    print("The add-on works")
except BaseException:
    traceback.print_exc()
    sys.exit(1)
