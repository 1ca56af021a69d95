// SPDX-License-Identifier: GPL-3.0-or-later

// Stands in for Flamenco Manager: compiles a job with the script and prints what comes of it.
//   node flamenco_stand_in.js SCRIPT.js < {"settings": ...}
// Its `author`, `path` and `print` are those that Flamenco documents for job types.

const fs = require("fs");
const vm = require("vm");

const source = fs.readFileSync(process.argv[2], "utf8");
const job = { created: new Date(), tasks: [], addTask(task) { this.tasks.push(task); } };
Object.assign(job, JSON.parse(fs.readFileSync(0, "utf8")));

function need(value, type, what) {
    if (typeof value !== type || value === "") {
        throw new Error(`${what} must be a ${type}, not ${JSON.stringify(value)}`);
    }
}

const author = {
    Task(name, type) {
        need(name, "string", "a task's name");
        need(type, "string", "a task's type");
        return { name, type, commands: [], addCommand(command) { this.commands.push(command); } };
    },
    Command(name, parameters) {
        need(name, "string", "a command's name");
        need(parameters, "object", "a command's parameters");
        return { name, parameters };
    },
};
// Strict, as Flamenco compiles; and without anything of Node's.
const context = vm.createContext({ author, path: require("path").posix, print() {} });
const run = `"use strict";\n${source}\n;({ JOB_TYPE, compileJob })`;
const { JOB_TYPE, compileJob } = vm.runInContext(run, context);

let error = null;
if (job.settings) {
    try {
        compileJob(job);
    } catch (thrown) {
        error = String(thrown);
    }
}
process.stdout.write(JSON.stringify({ type: JOB_TYPE, tasks: job.tasks, error }));
