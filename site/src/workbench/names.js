// Names of files in the only folder.

/** The name of a file as one there: none that reads as an option, as a folder, or as what the stage keeps. */
export const fileName = (name) => name.replace(/[/\\]/g, "_").replace(/^[-.]/, "_");
