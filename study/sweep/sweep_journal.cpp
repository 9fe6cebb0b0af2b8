#include "study/sweep/sweep_journal.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <iterator>
#include <system_error>

#include "model/error.hpp"
#include "model/fingerprint.hpp"

namespace rtu::study {
namespace {

constexpr std::size_t digits = 16;

[[noreturn]] void fail(const std::filesystem::path& path) {
    throw Error("{}: cannot write: {}", path.string(), std::generic_category().message(errno));
}

bool is_whole(std::string_view line) {
    return line.size() > digits && line[digits] == ' ' &&
           line.substr(0, digits) == model::hex_digits(model::fingerprint(line.substr(digits + 1)));
}

}  // namespace

JournalWriter::JournalWriter(const std::filesystem::path& path)
    : path_(path),
      descriptor_(::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_APPEND | O_CLOEXEC, 0666)) {
    if (descriptor_ < 0) fail(path_);
}

JournalWriter::~JournalWriter() { ::close(descriptor_); }

void JournalWriter::add(std::string_view text) {
    const std::string line = fmt::format("{} {}\n", model::hex_digits(model::fingerprint(text)), text);
    std::string_view rest = line;
    while (!rest.empty()) {
        const ssize_t count = ::write(descriptor_, rest.data(), rest.size());
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) fail(path_);
        rest.remove_prefix(std::size_t(count));
    }
}

JournalPart read_journal(const std::filesystem::path& path, std::uint64_t offset) {
    std::ifstream stream(path, std::ios::binary);
    stream.seekg(std::streamoff(offset));
    const std::string bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
    JournalPart part{{}, offset};
    std::string_view rest = bytes;
    for (std::size_t end = rest.find('\n'); end != std::string_view::npos; end = rest.find('\n')) {
        if (!is_whole(rest.substr(0, end))) break;
        part.lines.emplace_back(rest.substr(digits + 1, end - digits - 1));
        part.end += end + 1;
        rest.remove_prefix(end + 1);
    }
    return part;
}

}  // namespace rtu::study
