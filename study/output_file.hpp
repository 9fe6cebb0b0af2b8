#pragma once

#include <filesystem>
#include <span>
#include <string>

namespace rtu::study {

/// A file to be written: where, and all its bytes.
struct OutputFile {
    std::filesystem::path path;
    std::string bytes;
};

/// Throws Error unless a file can be written at `path`: its folder exists and takes new files, and what is
/// there already is a file or device that may be written. Leaves nothing behind.
void check_writable(const std::filesystem::path& path);

/// Throws Error unless `folder` is a folder that takes new files, or can be made. Leaves nothing behind.
void check_writable_folder(const std::filesystem::path& folder);

/// Writes all files or none: every file is first written in full under a temporary name in its own folder,
/// then devices and pipes are written directly, then all files are renamed. Missing folders are made. Throws
/// Error naming the file that failed; no temporary file is left.
void write_files(std::span<const OutputFile> files);

/// From now on SIGINT, SIGTERM, SIGHUP (unless ignored, as under nohup) and SIGPIPE end the process at once
/// with exit code 128 + signal, after removing the temporary files of a `write_files` under way.
void remove_temporaries_on_interrupt();

}  // namespace rtu::study
