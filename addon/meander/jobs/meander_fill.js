// SPDX-License-Identifier: GPL-3.0-or-later
//
// A job type for Flamenco 3: fills what a job file of Meander says, in as many tasks as you like.
// Copy it into the folder "scripts" beside flamenco-manager. Job file and add-on have to lie where
// all workers see them. Written in the JavaScript that every engine knows: no let, no arrows.

const JOB_TYPE = {
    label: "Meander: Fill Surfaces",
    description: "Fill the surfaces of a job file with evenly spaced curves",
    settings: [
        { key: "job_file", type: "string", subtype: "file_path", required: true,
          description: "Job file (TOML) that says what is to be filled" },
        { key: "farm_script", type: "string", subtype: "file_path", required: true,
          description: "farm.py in the folder of the Meander add-on" },
        { key: "tasks", type: "int32", default: 4, propargs: { min: 1, max: 10000 },
          description: "Number of tasks that share the items of the job file" },
        { key: "at_once", type: "int32", default: 1, propargs: { min: 1, max: 64 },
          description: "Number of items that a task runs at the same time" },
    ],
};

function compileJob(job) {
    const settings = job.settings;
    const count = settings.tasks;
    if (!(count >= 1)) {
        throw new Error("Meander: the number of tasks must be 1 or more, not " + count);
    }
    const shards = [];
    for (var number = 1; number <= count; number++) {
        const shard = author.Task("fill-" + number + "-of-" + count, "blender");
        shard.addCommand(farmCommand(settings, [
            "--jobs", String(settings.at_once), "--shard", number + "/" + count,
        ]));
        shards.push(shard);
        job.addTask(shard);
    }
    // Fails, and says what is missing in its log, unless every item is done.
    const check = author.Task("check", "blender");
    check.addCommand(farmCommand(settings, ["--status"]));
    shards.forEach(function (shard) { check.addDependency(shard); });
    job.addTask(check);
}

// Blender brings a Python with numpy. "blender-render" would need a .blend to open.
function farmCommand(settings, args) {
    return author.Command("exec", {
        exe: "{blender}",
        args: [
            "--background", "--factory-startup", "--python-exit-code", "1",
            "--python", settings.farm_script, "--", settings.job_file,
        ].concat(args),
    });
}
