// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// PLY files as their headers describe them.
namespace hogel::scene::mesh_files::ply {

struct Type {
    std::string_view name, other_name;
    std::size_t size;
    bool is_integer;
};

struct Property {
    std::string name;
    Type type;
    std::optional<Type> count;  ///< type of a list's length; none for a single value
};

struct Element {
    std::string name;  ///< for messages
    std::size_t count = 0;
    std::vector<Property> properties;
};

enum class Format { ascii, little_endian, big_endian };

struct Header {
    Format format = Format::ascii;
    std::vector<Element> elements;
    std::size_t size = 0;  ///< bytes up to the data
};

/// Throws Error(bad_input), which names the line.
Header parse_header(const std::string& file, std::string_view bytes);

/// The words of a line, one after the other.
class Words {
  public:
    explicit Words(std::string_view line) : rest_(line) {}
    /// Empty at the end of the line.
    std::string_view next();
    std::size_t bytes_left() const { return rest_.size(); }

  private:
    std::string_view rest_;
};

}  // namespace hogel::scene::mesh_files::ply
