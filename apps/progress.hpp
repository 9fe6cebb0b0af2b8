#pragma once

#include <string_view>

namespace rtu::apps {

/// Goes to the beginning of a terminal's line and empties it.
inline constexpr std::string_view clear_line = "\r\x1b[K";

/// One line on standard error that is overwritten by the next and gone at the end; silent unless standard
/// error is a terminal.
class Progress {
  public:
    Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    ~Progress();
    void show(std::string_view scene, std::string_view phase);

  private:
    bool is_terminal_;
};

}  // namespace rtu::apps
