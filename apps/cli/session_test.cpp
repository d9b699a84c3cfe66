// SPDX-License-Identifier: Apache-2.0
#include "session.h"

#include <gtest/gtest.h>
#include <unistd.h>

namespace hogel::cli {
namespace {

// Redirects the standard error to line() during its lifetime.
class ReadErrors {
  public:
    ReadErrors() : before_(dup(STDERR_FILENO)) {
        int ends[2];
        EXPECT_EQ(pipe(ends), 0);
        dup2(ends[1], STDERR_FILENO);
        close(ends[1]);
        pipe_ = ends[0];
    }
    ~ReadErrors() {
        dup2(before_, STDERR_FILENO);
        close(before_);
        close(pipe_);
    }
    ReadErrors(const ReadErrors&) = delete;
    ReadErrors& operator=(const ReadErrors&) = delete;

    // Waits for a line.
    std::string line() const {
        std::string text;
        for (char c = 0; c != '\n' && read(pipe_, &c, 1) == 1;) text += c;
        return text;
    }

  private:
    int before_, pipe_ = -1;
};

TEST(Stage, says_how_far_it_is_in_lines_where_there_is_no_terminal) {
    const ReadErrors errors;
    const Session session;
    Stage stage(session, "rendering", std::chrono::milliseconds(5));
    EXPECT_TRUE(errors.line().starts_with("rendering: 0%, "));
    stage.progress(1, 2).report(0.5);
    std::string line = errors.line();
    while (line.starts_with("rendering: 0%")) line = errors.line();
    EXPECT_TRUE(line.starts_with("rendering: 75%, ")) << line;
    EXPECT_TRUE(line.ends_with(" left\n")) << line;
}

}  // namespace
}  // namespace hogel::cli
