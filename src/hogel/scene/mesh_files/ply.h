// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Headers and rows of PLY files.
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
    std::vector<std::string> textures;  ///< lines "comment TextureFile NAME"
    std::size_t size = 0;               ///< bytes up to the data
};

/// Parses the header. Throws Error(bad_input), naming the line.
Header parse_header(const std::string& file, std::string_view bytes);

/// Sequential reader of the words of a line.
class Words {
  public:
    explicit Words(std::string_view line) : rest_(line) {}
    /// Returns the next word; empty at the end of the line.
    std::string_view next();
    std::size_t bytes_left() const { return rest_.size(); }

  private:
    std::string_view rest_;
};

/// One row of an element.
struct Row {
    std::vector<double> values;
    std::vector<std::size_t> ends;  ///< of each property's values

    /// Returns the value of a property, or the values of its list.
    std::span<const double> operator[](std::size_t property) const {
        const std::size_t begin = property == 0 ? 0 : ends[property - 1];
        return std::span(values).subspan(begin, ends[property] - begin);
    }
};

/// Sequential reader of rows. Throws Error(bad_input), naming element and row, for invalid or missing data.
class RowReader {
  public:
    /// @param file, data  must outlive the reader; `data` follows the header
    RowReader(const std::string& file, Format format, std::string_view data)
        : file_(&file), format_(format), data_(data) {}
    /// Throws unless the remaining data can hold all rows of an element. Called before memory is reserved.
    void check_room(const Element& element) const;
    /// @param number  index of the row in its element
    void read(const Element& element, std::size_t number, Row& row);
    /// Skips and checks all rows of an element.
    void skip(const Element& element);

  private:
    void read_text(const Element& element, std::size_t number, Row& row);
    void read_binary(const Element& element, std::size_t number, Row& row);
    std::string_view take(const Element& element, std::size_t number, std::size_t bytes);
    [[noreturn]] void reject_end(const Element& element, std::size_t rows) const;

    const std::string* file_;
    Format format_;
    std::string_view data_;
};

/// Parses a word as a number; nothing if it is not one.
std::optional<double> parse_number(std::string_view word);

}  // namespace hogel::scene::mesh_files::ply
