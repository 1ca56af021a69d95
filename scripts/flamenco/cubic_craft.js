// SPDX-License-Identifier: GPL-3.0-or-later

// A job type for Flamenco 3, Blender's render farm: each mesh of a folder is a task, in which a
// worker's Blender runs headless_render.py. How to install it: docs/batch.md.

const JOB_TYPE = {
    label: "CubicCraft",
    settings: [
        {
            key: "script", type: "string", subtype: "file_path", required: true,
            description: "scripts/headless_render.py of CubicCraft, where all workers can read it",
        },
        {
            key: "input_folder", type: "string", subtype: "dir_path", required: true,
            description: "Folder with the meshes, where all workers can read it",
        },
        {
            key: "output_folder", type: "string", subtype: "dir_path", required: true,
            description: "Folder for the results; it is made if it is not there",
        },
        {
            key: "cubeness", type: "string", required: true, default: "0.4",
            description: "How cubic; several values, such as '0.2 0.4', give several results",
        },
        {
            key: "pictures", type: "bool", required: true, default: true,
            description: "Render the original beside its cubic versions",
        },
        {
            key: "mesh_format", type: "string", required: true, default: ".obj",
            choices: ["none", ".obj", ".ply", ".usdc", ".abc", ".blend"],
            description: "Format in which the results are saved",
        },
        {
            key: "timeout", type: "int32", required: true, default: 3600,
            description: "Seconds after which a mesh is given up",
        },
        {
            key: "memory", type: "float", required: true, default: 32,
            description: "Gigabytes of memory beyond which a mesh is given up",
        },
        {
            key: "options", type: "string", required: false, default: "",
            description: "More options of headless_render.py, such as: --solidity 0.3 --samples 64",
        },
        // The Manager runs this script without access to files, so the add-on lists them.
        // It evaluates with local names only, which in a generator exist in its first "in" alone.
        {
            key: "files", type: "string", required: true, visible: "web",
            eval: "__import__('json').dumps(sorted(p.name"
                + " for p in Path(abspath(settings.input_folder)).iterdir()"
                + " if p.name[0] != '.' and p.suffix.lower() in ('.obj', '.ply', '.stl', '.glb',"
                + " '.gltf', '.fbx', '.usd', '.usdc', '.usda', '.usdz', '.abc', '.blend')))",
            description: "Names of the meshes in the folder, as a JSON list",
        },
    ],
};

function compileJob(job) {
    const settings = job.settings;
    const names = JSON.parse(settings.files);
    if (!Array.isArray(names) || names.length === 0) {
        throw "there are no meshes in the input folder " + settings.input_folder;
    }
    if (!settings.pictures && settings.mesh_format === "none") {
        throw "nothing to write: switch pictures on, or choose a mesh format";
    }
    const results = namesOfResults(names);
    for (let i = 0; i < names.length; i++) {
        job.addTask(authorTask(settings, names[i], results[i]));
    }
}

function authorTask(settings, name, result) {
    const task = author.Task(name, "blender");
    task.addCommand(author.Command("make-directory", { path: settings.output_folder }));
    task.addCommand(author.Command("blender-render", {
        exe: "{blender}",
        exeArgs: "{blenderArgs}",
        // Without the exit code Blender would not tell of an error in a script.
        argsBefore: ["--background", "--python-exit-code", "1"],
        blendfile: "",
        args: ["--python", settings.script, "--"].concat(scriptArguments(settings, name, result)),
    }));
    return task;
}

// The arguments of headless_render.py for one file.
function scriptArguments(settings, name, result) {
    const output = path.join(settings.output_folder, result);
    let args = [path.join(settings.input_folder, name), "--cubeness"];
    args = args.concat(words(settings.cubeness));
    args = args.concat(settings.pictures ? ["--output", output + ".png"] : ["--no-render"]);
    if (settings.mesh_format !== "none") {
        args.push("--save-mesh", output + settings.mesh_format);
    }
    // A mesh that cannot be used must not fail its task: after three, Flamenco blames the worker.
    args.push("--report", output + ".json", "--error-file", output + ".error.txt");
    args.push("--timeout", String(settings.timeout), "--memory", String(settings.memory));
    return args.concat(words(settings.options || ""));
}

// Words as in a shell; "double quotes" keep spaces.
function words(text) {
    return (text.match(/(?:[^\s"]|"[^"]*")+/g) || []).map((word) => word.replace(/"/g, ""));
}

// Names without suffix; files that differ in it alone have it in theirs, so that no result
// overwrites another, also where upper and lower case are the same.
function namesOfResults(names) {
    const stems = names.map((name) => name.replace(/\.[^.]*$/, ""));
    const counts = {};
    for (const stem of stems) {
        const key = "stem " + stem.toLowerCase();
        counts[key] = (counts[key] || 0) + 1;
    }
    const results = names.map((name, i) =>
        counts["stem " + stems[i].toLowerCase()] > 1 ? name.replace(/\.([^.]*)$/, "_$1") : stems[i]);
    const taken = {};
    for (const result of results) {
        const key = "name " + result.toLowerCase();
        if (taken[key]) {
            throw "two files would be named " + result + "; rename one of them";
        }
        taken[key] = true;
    }
    return results;
}
