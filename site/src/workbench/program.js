// The delone program itself, compiled to WebAssembly with WASI: it runs with files that are arrays of bytes, and writes others. So a page
// has every reader, writer and view of the program, and the commands that it shows are those that it ran.

import {ConsoleStdout, Directory, File, OpenFile, PreopenDirectory, WASI} from "@bjorn3/browser_wasi_shim";

/** Bytes that a file grows to at least when it is written; then it doubles. */
const FIRST_ROOM = 1 << 16;

/** A file open for writing, whose room doubles: the shim's own grows by each write, and copies all that there is. */
class Growing extends OpenFile {
  fd_write(bytes) {
    const [start, end] = [Number(this.file_pos), Number(this.file_pos) + bytes.length];
    this.file.reserve(end);
    this.file.room.set(bytes, start);
    this.file.end(Math.max(this.file.data.length, end));
    this.file_pos = BigInt(end);
    return {ret: 0, nwritten: bytes.length};
  }

  fd_pwrite(bytes, offset) {
    const before = this.file_pos;
    this.file_pos = offset;
    const done = this.fd_write(bytes);
    this.file_pos = before;
    return done;
  }
}

/** A file that the program writes. */
class Output extends File {
  room = new Uint8Array(0);

  path_open(oflags, rights, flags) {
    const opened = super.path_open(oflags, rights, flags);
    if (opened.fd_obj) opened.fd_obj = Object.assign(new Growing(this), {file_pos: opened.fd_obj.file_pos});
    return opened;
  }

  reserve(count) {
    if (count <= this.room.length) return;
    const room = new Uint8Array(Math.max(count, 2 * this.room.length, FIRST_ROOM));
    room.set(this.data);
    this.room = room;
  }

  end(count) {
    this.data = this.room.subarray(0, count);
  }
}

/** The folder in which the program runs, and those that it makes there. */
class Folder extends Directory {
  create_entry_for_path(path, isFolder) {
    const made = super.create_entry_for_path(path, isFolder);
    if (!made.entry || isFolder) return made;
    const names = path.split("/").filter((name) => name && name !== ".");
    const last = names.pop();
    const folder = names.reduce((folder, name) => folder.contents.get(name), this);
    const entry = new Output(new Uint8Array(0));
    folder.contents.set(last, entry);
    return {...made, entry};
  }
}

/** A file with these bytes, which are not copied. */
function input(bytes) {
  const file = new File(new Uint8Array(0), {readonly: true});
  file.data = bytes;
  return file;
}

/**
 * Runs the program with arguments and files: bytes by name, all in one folder. Gives its exit status, its lines on standard error and
 * standard output, and the files that it wrote. `tell` hears of each line while it runs.
 */
export async function run(module, args, files, tell = () => {}) {
  const [errors, prints] = [[], []];
  const contents = new Map(Object.entries(files).map(([name, bytes]) => [name, input(bytes)]));
  const root = new PreopenDirectory("/", new Map());
  root.dir = new Folder(contents);
  const hear = (lines) => ConsoleStdout.lineBuffered((line) => (lines.push(line), tell(line)));
  const wasi = new WASI(["delone", ...args], [], [new ConsoleStdout(() => {}), hear(prints), hear(errors), root], {debug: false});
  let status;
  try {
    const instance = await WebAssembly.instantiate(module, {wasi_snapshot_preview1: wasi.wasiImport});
    status = wasi.start(instance);
  } catch (error) {
    // The program aborts where memory ends.
    if (!(error instanceof WebAssembly.RuntimeError || error instanceof RangeError)) throw error;
    status = 1;
    const isMemory = errors.some((line) => /memory|allocation|capacity overflow/.test(line)) || error instanceof RangeError;
    errors.push(isMemory ? "error: this is more than fits into the memory of a page" : `error: the program stopped: ${error.message}`);
  }
  const written = {};
  for (const [name, file] of contents) if (file instanceof Output) written[name] = file.data;
  return {status, errors, prints, written};
}
