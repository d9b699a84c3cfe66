// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <initializer_list>
#include <map>
#include <string>
#include <string_view>

#include "hogel/image.h"
#include "session.h"

namespace hogel::cli {

/// What the outputs of a run say of the command that made them. The rule for all commands: an option is stored if it
/// acted on the output, with the value that acted. So a record begins without options, and the code that lets an option
/// act says so. Options of which nothing was said, because the input, another option or the method made them idle, are
/// left out: their values, defaults above all, would be false.
class RunRecord {
  public:
    explicit RunRecord(const Session& session) : session_(&session) {}

    /// These options acted ("fov", without dashes), with the values on the command line or their defaults. Names that
    /// the command does not have are ignored, because commands share code.
    void acted(std::initializer_list<std::string_view> options);
    /// An option acted with another value, which its default stands for or which was made of what was given.
    void acted(std::string_view option, const std::string& value);
    /// An option that acted elsewhere had no part in this output.
    void idle(std::string_view option);

    /// All options that acted in another record acted here too.
    void add(const RunRecord& other) { acted_.insert(other.acted_.begin(), other.acted_.end()); }

    /// The version, the command, and the options that acted, in the order of the command's declarations.
    Metadata metadata() const;

  private:
    const Session* session_;
    std::map<std::string, std::string, std::less<>> acted_;  // an empty text: the value of the command line
};

}  // namespace hogel::cli
