"""Safe readers of untrusted files: within limits, or refused before memory is taken.

limits        Limits of the size of a file and of what it announces, and how they are raised.
texts         Texts of limited size, and plain values of limited depth from TOML and JSON.
archives      Zip archives: names, sizes and compression ratio checked before a member is read.
arrays        Arrays of npy and npz files: no pickle, no more than the file holds.
named_files   Files that a description names: there, with their checksum, and read once.
images        Images of planforms: npy arrays and PNG files.
xml_elements  XML without a document type, of limited depth.
references    Files that a scene file names: found from its folder, in it or in its project.
"""
