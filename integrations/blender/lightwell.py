# SPDX-License-Identifier: Apache-2.0
"""Bakes the light of the scene with Lightwell, and shows it in the browser. For Blender 3.4 and newer.

Install it by Edit > Preferences > Add-ons > Install, and say there where the program `lightwell` is. The sidebar of the 3D
view then has a tab "Lightwell". From scripts: bpy.ops.lightwell.bake() and bpy.ops.lightwell.show(), which return when they are
done and raise RuntimeError when something is wrong.
"""

import atexit
import json
import os
import shlex
import shutil
import subprocess
import tempfile
import threading
import webbrowser

import bpy

bl_info = {
    "name": "Lightwell",
    "description": "Bakes the indirect light of the scene and shows it in the browser",
    "author": "The Lightwell authors",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "3D View > Sidebar > Lightwell",
    "category": "Render",
}


class LightwellError(Exception):
    """What is said to the user."""


# What is baked


def export_scene(path):
    """Writes what is visible as GLB, with lamps and cameras. Options that this Blender's exporter does not know are left out."""
    options = {
        "export_format": "GLB",
        "export_apply": True,
        "export_lights": True,
        "export_cameras": True,
        "export_extras": True,
        "export_animations": False,
        "use_visible": True,
        "use_active_scene": True,
    }
    # The exporter would write the add-on's own settings, and so the user's paths, into the file.
    scene = bpy.context.scene
    settings = scene["lightwell"].to_dict() if "lightwell" in scene else None
    if settings is not None:
        del scene["lightwell"]
    try:
        known = bpy.ops.export_scene.gltf.get_rna_type().properties.keys()
        bpy.ops.export_scene.gltf(filepath=path, **{name: value for name, value in options.items() if name in known})
    except (AttributeError, KeyError, RuntimeError) as error:
        raise LightwellError(f"Blender's own add-on for glTF 2.0 cannot export the scene: {last_line(error)}") from error
    finally:
        if settings is not None:
            scene["lightwell"] = settings


def world_background(scene):
    """The node of the world that makes the background, None where a plain colour or nothing does."""
    world = scene.world
    if world is None or not world.use_nodes:
        return None
    outputs = [node for node in world.node_tree.nodes if node.type == "OUTPUT_WORLD" and node.is_active_output]
    links = outputs[0].inputs["Surface"].links if outputs else []
    return links[0].from_node if links and links[0].from_node.type == "BACKGROUND" else None


def surroundings(scene, folder):
    """The options of `lightwell bake` for the world: a sky with the sun's lamp, a picture, or a colour."""
    if scene.world is None:
        return []
    background = world_background(scene)
    if background is None:
        return [] if scene.world.use_nodes else color_option(scene.world.color, 1)
    strength = background.inputs["Strength"].default_value
    links = background.inputs["Color"].links
    source = links[0].from_node if links else None
    if source is None:
        return color_option(background.inputs["Color"].default_value, strength)
    if source.type == "TEX_SKY":
        has_sun = any(thing.type == "LIGHT" and thing.data.type == "SUN" and thing.visible_get() for thing in scene.objects)
        if not has_sun:
            raise LightwellError("the world has a sky, but the scene no sun: add a lamp of type Sun")
        turbidity = source.turbidity if source.sky_type in ("PREETHAM", "HOSEK_WILKIE") else 3
        return ["--sky", f"{min(max(turbidity, 1), 10):g}"]
    if source.type == "TEX_ENVIRONMENT" and source.image is not None:
        path = os.path.join(folder, "world.hdr")
        write_picture(source.image, strength, path)
        return ["--environment", path]
    return []


def color_option(color, strength):
    values = [max(0.0, channel * strength) for channel in color[:3]]
    return ["--environment", ",".join(f"{value:.6g}" for value in values)] if max(values) > 0 else []


def write_picture(image, strength, path):
    """Writes a picture of the surroundings as Lightwell reads it, whose middle is Blender's +y instead of its +x."""
    import numpy

    width, height = image.size
    if width == 0:
        raise LightwellError(f"the world's picture {image.name} cannot be read")
    pixels = numpy.empty(width * height * 4, dtype=numpy.float32)
    image.pixels.foreach_get(pixels)
    turned = numpy.roll(pixels.reshape(height, width, 4), width // 4, axis=1) * strength
    copy = bpy.data.images.new("Lightwell", width, height, float_buffer=True)
    try:
        copy.pixels.foreach_set(turned.ravel())
        copy.filepath_raw = path
        copy.file_format = "HDR"
        copy.save()
    finally:
        bpy.data.images.remove(copy)


def pack_path(scene):
    """Where the pack goes: as the scene says, else beside the file of Blender, else into the folder for temporary files."""
    if scene.lightwell.pack:
        path = bpy.path.abspath(scene.lightwell.pack)
        return path if path.endswith(".glb") else path + ".lw.glb"
    if bpy.data.filepath:
        return os.path.splitext(bpy.data.filepath)[0] + ".lw.glb"
    return os.path.join(tempfile.gettempdir(), "untitled.lw.glb")


def last_line(text):
    lines = str(text).strip().splitlines()
    return lines[-1] if lines else "it says nothing"


# The program


def program(context):
    """Where `lightwell` is."""
    chosen = bpy.path.abspath(context.preferences.addons[__name__].preferences.program)
    found = shutil.which(chosen)
    if found is None:
        raise LightwellError(f"there is no program {chosen}: say in the add-on's preferences where lightwell is")
    return found


class Bake:
    """A run of `lightwell bake`."""

    def __init__(self, context):
        scene = context.scene
        lightwell = program(context)
        self.pack = pack_path(scene)
        self.folder = tempfile.TemporaryDirectory(prefix="lightwell-")
        try:
            glb = os.path.join(self.folder.name, "scene.glb")
            command = [lightwell, "bake", glb, "-o", self.pack, *surroundings(scene, self.folder.name)]
            if scene.lightwell.preview:
                command.append("--preview")
            command += shlex.split(scene.lightwell.options)
            export_scene(glb)
            self.process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        except BaseException:
            self.folder.cleanup()
            raise
        self.lines = []
        self.reader = threading.Thread(target=self.read, daemon=True)
        self.reader.start()

    def read(self):
        for line in self.process.stderr:
            self.lines.append(line.strip())

    @property
    def running(self):
        return self.process.poll() is None

    def cancel(self):
        self.process.terminate()

    def finish(self):
        """Waits for the end; returns the warnings."""
        status = self.process.wait()
        self.reader.join()
        self.folder.cleanup()
        if status != 0:
            raise LightwellError(last_line("\n".join(self.lines)).replace("lightwell: ", ""))
        return [line for line in self.lines if line.startswith("lightwell: warning: ")]


class Server:
    """The `lightwell serve` that shows a pack; one at a time."""

    process = None
    pack = None
    url = None

    @classmethod
    def show(cls, context, pack):
        if not os.path.exists(pack):
            raise LightwellError(f"{pack} is not there yet: bake first")
        if cls.process is None or cls.process.poll() is not None or cls.pack != pack:
            cls.stop()
            cls.start([program(context), "serve", pack, "--port", "0", "--json"])
            cls.pack = pack
        webbrowser.open(cls.url)

    @classmethod
    def start(cls, command):
        # What it says later must not fill a pipe that nobody reads.
        with tempfile.TemporaryFile("w+") as errors:
            cls.process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=errors, text=True)
            line = cls.process.stdout.readline()
            if not line:
                cls.stop()
                errors.seek(0)
                raise LightwellError(last_line(errors.read()).replace("lightwell: ", ""))
        cls.url = json.loads(line)["url"]

    @classmethod
    def stop(cls):
        if cls.process is None:
            return
        cls.process.terminate()
        cls.process.wait()
        cls.process.stdout.close()
        cls.process = None


# What the user sees


class LightwellPreferences(bpy.types.AddonPreferences):
    bl_idname = __name__

    program: bpy.props.StringProperty(
        name="Program", description="Where the program lightwell is", subtype="FILE_PATH", default="lightwell"
    )

    def draw(self, _context):
        self.layout.prop(self, "program")


class LightwellSettings(bpy.types.PropertyGroup):
    pack: bpy.props.StringProperty(
        name="Pack", description="The file to bake; if empty, FILE.lw.glb beside the file of Blender", subtype="FILE_PATH"
    )
    preview: bpy.props.BoolProperty(name="Preview", description="A first light in seconds")
    options: bpy.props.StringProperty(name="Options", description="More options of `lightwell bake`, such as --target-error 2")


class LIGHTWELL_OT_bake(bpy.types.Operator):
    """Bake the light of what is visible into a pack"""

    bl_idname = "lightwell.bake"
    bl_label = "Bake"

    bake = None
    timer = None

    @classmethod
    def poll(cls, context):
        return context.mode == "OBJECT"

    def execute(self, context):
        try:
            self.bake = Bake(context)
            return self.end()
        except LightwellError as error:
            return self.fail(error)

    def invoke(self, context, _event):
        try:
            self.bake = Bake(context)
        except LightwellError as error:
            return self.fail(error)
        self.timer = context.window_manager.event_timer_add(0.2, window=context.window)
        context.window_manager.modal_handler_add(self)
        context.workspace.status_text_set("Lightwell bakes; Esc cancels")
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        if event.type == "ESC":
            self.bake.cancel()
        if event.type != "TIMER" or self.bake.running:
            return {"PASS_THROUGH"}
        context.window_manager.event_timer_remove(self.timer)
        context.workspace.status_text_set(None)
        try:
            return self.end()
        except LightwellError as error:
            return self.fail(error)

    def end(self):
        for warning in self.bake.finish():
            self.report({"WARNING"}, warning)
        self.report({"INFO"}, f"Lightwell has baked {self.bake.pack}")
        return {"FINISHED"}

    def fail(self, error):
        self.report({"ERROR"}, f"Lightwell: {error}")
        return {"CANCELLED"}


class LIGHTWELL_OT_show(bpy.types.Operator):
    """Show the pack in the browser"""

    bl_idname = "lightwell.show"
    bl_label = "Show"

    def execute(self, context):
        try:
            Server.show(context, pack_path(context.scene))
        except LightwellError as error:
            self.report({"ERROR"}, f"Lightwell: {error}")
            return {"CANCELLED"}
        self.report({"INFO"}, f"Lightwell is at {Server.url}")
        return {"FINISHED"}


class LIGHTWELL_PT_panel(bpy.types.Panel):
    bl_label = "Lightwell"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Lightwell"

    def draw(self, context):
        settings = context.scene.lightwell
        self.layout.use_property_split = True
        for name in ("pack", "preview", "options"):
            self.layout.prop(settings, name)
        row = self.layout.row(align=True)
        row.operator("lightwell.bake", icon="LIGHT_SUN")
        row.operator("lightwell.show", icon="URL")


CLASSES = (LightwellPreferences, LightwellSettings, LIGHTWELL_OT_bake, LIGHTWELL_OT_show, LIGHTWELL_PT_panel)


def register():
    for each in CLASSES:
        bpy.utils.register_class(each)
    bpy.types.Scene.lightwell = bpy.props.PointerProperty(type=LightwellSettings)
    atexit.register(Server.stop)


def unregister():
    atexit.unregister(Server.stop)
    Server.stop()
    del bpy.types.Scene.lightwell
    for each in reversed(CLASSES):
        bpy.utils.unregister_class(each)
