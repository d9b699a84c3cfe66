// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "hogel/export.h"

namespace hogel {

/// Returns the word that a mistyped one probably means, or an empty text. Candidates are within one insertion,
/// deletion, replacement or swap of letters per three letters (at least one). The nearest wins, and the first of
/// equally near ones. Without a candidate it returns the first of `words` that begins with `word`, if that has three or
/// more letters.
HOGEL_API std::string nearest_word(std::string_view word, std::span<const std::string> words);

/// Throws Error(usage) because no `kind` ("renderer") of this name exists. The message has the nearest name and all
/// names.
/// @param parameter  parameter with the name as its value, see Error::parameter()
[[noreturn]] HOGEL_API void throw_unknown(std::string_view kind, std::string_view name,
                                          std::span<const std::string> known, const std::string& parameter = "");

/// Throws Error(usage) because a `kind` of this name already exists.
[[noreturn]] HOGEL_API void throw_known(std::string_view kind, std::string_view name);

/// A registry of named rows of one kind: renderers, coders, scenes. The library fills each table; a program can add
/// rows at run time. All functions are thread-safe. Row has a member `name`. References to rows stay valid.
template <class Row>
class Table {
  public:
    /// @param kind       singular noun for messages: "renderer"
    /// @param parameter  parameter with these names as values, for errors: "algorithm"
    Table(std::string kind, std::vector<Row> rows, std::string parameter = "")
        : kind_(std::move(kind)), parameter_(std::move(parameter)) {
        for (Row& row : rows) rows_.push_back(std::move(row));
    }

    /// Returns all rows in display order; added rows come last.
    std::vector<Row> rows() const {
        const std::lock_guard lock(mutex_);
        return {rows_.begin(), rows_.end()};
    }
    std::vector<std::string> names() const {
        const std::lock_guard lock(mutex_);
        std::vector<std::string> names;
        for (const Row& row : rows_) names.emplace_back(row.name);
        return names;
    }
    /// Returns the row of this name, or null.
    const Row* look_up(std::string_view name) const {
        const std::lock_guard lock(mutex_);
        for (const Row& row : rows_)
            if (row.name == name) return &row;
        return nullptr;
    }
    /// Returns the row of this name. Throws Error(usage) for an unknown name, with the nearest name and all names.
    const Row& find(std::string_view name) const {
        if (const Row* row = look_up(name)) return *row;
        throw_unknown(kind_, name, names(), parameter_);
    }
    /// Adds a row. Throws Error(usage) if the name is taken.
    void add(Row row) {
        const std::lock_guard lock(mutex_);
        for (const Row& other : rows_)
            if (other.name == row.name) throw_known(kind_, row.name);
        rows_.push_back(std::move(row));
    }

  private:
    std::string kind_, parameter_;
    mutable std::mutex mutex_;
    std::deque<Row> rows_;
};

}  // namespace hogel
