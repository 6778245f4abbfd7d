// SPDX-License-Identifier: GPL-3.0-or-later
//
// Stands for Flamenco Manager, made from the documentation of Flamenco 3 ("Job Types", "List of
// Commands", "Variables"): what a script finds there, and what it refuses. Written for engines that
// know no more than the script itself may use. Run behind the script and a line that sets SETTINGS.

const TASK_TYPES = ["blender", "ffmpeg", "file-management", "misc"];
const SETTING_TYPES = { string: "string", int32: "number", float: "number", bool: "boolean" };
const SUBTYPES = ["file_path", "dir_path", "hashed_file_path"];
// Parameters of the commands that a worker knows; a list stands for many texts.
const COMMANDS = {
    "exec": { exe: "string", args: "list" },
    "echo": { message: "string" },
    "sleep": { duration_in_seconds: "number" },
    "blender-render": {
        exe: "string", exeArgs: "string", argsBefore: "list", blendfile: "string", args: "list",
    },
};

function demand(condition, text) {
    if (!condition) { throw new Error(text); }
}

function isA(value, kind) {
    if (kind !== "list") { return typeof value === kind; }
    return Array.isArray(value) && value.every(function (one) { return typeof one === "string"; });
}

function Command(name, parameters) {
    demand(COMMANDS.hasOwnProperty(name), "no such command: " + name);
    Object.keys(parameters).forEach(function (key) {
        demand(COMMANDS[name].hasOwnProperty(key), name + " has no parameter " + key);
        demand(isA(parameters[key], COMMANDS[name][key]), name + ": " + key + " is of another kind");
    });
    this.name = name;
    this.parameters = parameters;
}

function Task(name, type) {
    demand(typeof name === "string" && name !== "", "a task has a name");
    demand(TASK_TYPES.indexOf(type) >= 0, "no such type of task: " + type);
    this.name = name;
    this.type = type;
    this.commands = [];
    this.dependencies = [];
}
Task.prototype.addCommand = function (command) {
    demand(command instanceof Command, "no command");
    this.commands.push(command);
};
Task.prototype.addDependency = function (task) {
    demand(task instanceof Task, "no task");
    this.dependencies.push(task.name);
};

const author = {
    Task: function (name, type) { return new Task(name, type); },
    Command: function (name, parameters) { return new Command(name, parameters); },
};

// The settings of a submitted job: what is given, and the defaults for the rest.
function settingsOf(given) {
    const settings = {};
    demand(typeof JOB_TYPE.label === "string", "a job type has a label");
    JOB_TYPE.settings.forEach(function (setting) {
        const kind = SETTING_TYPES[setting.type];
        demand(kind, setting.key + ": no such type of setting: " + setting.type);
        demand(!setting.subtype || SUBTYPES.indexOf(setting.subtype) >= 0, setting.subtype);
        demand(!settings.hasOwnProperty(setting.key), setting.key + " is there twice");
        const value = given.hasOwnProperty(setting.key) ? given[setting.key] : setting.default;
        demand(!setting.required || value !== undefined, setting.key + " is required");
        demand(value === undefined || typeof value === kind, setting.key + " is of another kind");
        settings[setting.key] = value;
    });
    Object.keys(given).forEach(function (key) {
        demand(settings.hasOwnProperty(key), "no such setting: " + key);
    });
    return settings;
}

const job = { name: "test", settings: settingsOf(SETTINGS), tasks: [] };
job.addTask = function (task) {
    demand(task instanceof Task, "no task");
    demand(task.commands.length > 0, task.name + " does nothing");
    task.dependencies.forEach(function (name) {
        demand(job.tasks.some(function (other) { return other.name === name; }),
            task.name + " depends on what is not there: " + name);
    });
    // A copy, as in Flamenco's Manager: what a script adds to the task afterwards is lost.
    job.tasks.push(JSON.parse(JSON.stringify(task)));
};
compileJob(job);
print(JSON.stringify(job.tasks));
