// SPDX-License-Identifier: GPL-3.0-or-later

// A job type for Flamenco 3: each mesh of a folder is a task. Copy it to the folder "scripts" beside
// flamenco-manager.

const JOB_TYPE = {
    label: "CubicCraft",
    settings: [
        {
            key: "input_folder", type: "string", subtype: "dir_path", required: true,
            description: "Folder with the meshes, where all workers can read it",
        },
        {
            key: "output_folder", type: "string", subtype: "dir_path", required: true,
            description: "Folder for the results; it is made if it is not there",
        },
        {
            key: "files", type: "int32", required: true, default: 1,
            description: "How many meshes there are in the folder",
        },
        {
            key: "options", type: "string", default: "--no-render --save-mesh .glb",
            description: "More options of the command line",
        },
    ],
};

function compileJob(job) {
    const settings = job.settings;
    for (let file = 1; file <= settings.files; file++) {
        // A mesh that cannot be used must not fail its task: after three, Flamenco blames the worker.
        const error = path.join(settings.output_folder, file + ".error.txt");
        const task = author.Task("mesh " + file, "blender");
        task.addCommand(author.Command("blender-render", {
            exe: "{blender}",
            exeArgs: "{blenderArgs}",
            argsBefore: ["--background", "--command", "cubic_craft", settings.input_folder,
                "--output-folder", settings.output_folder, "--only", String(file),
                "--error-file", error, "--options=" + settings.options],
            blendfile: "",
            args: [],
        }));
        job.addTask(task);
    }
}
