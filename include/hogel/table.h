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

/// The word that was probably meant by a mistyped one: the nearest by insertions, deletions, replacements and swaps of
/// letters, of which one is allowed for every three letters (at least one); otherwise the first of `words` that begins
/// with `word`, if that has three or more letters; otherwise an empty text. If several are equally near, the first of
/// them.
HOGEL_API std::string nearest_word(std::string_view word, std::span<const std::string> words);

/// Throws Error(usage) because no `kind` ("renderer") of that name exists. The message gives the nearest name and all
/// names that exist.
/// @param parameter  the parameter whose value the name is, see Error::parameter()
[[noreturn]] HOGEL_API void throw_unknown(std::string_view kind, std::string_view name,
                                          std::span<const std::string> known, const std::string& parameter = "");

/// Throws Error(usage) because a `kind` of that name already exists.
[[noreturn]] HOGEL_API void throw_known(std::string_view kind, std::string_view name);

/// A registry of everything of one kind by name: renderers, coders, scenes. The library fills each table; a program may
/// add rows at run time, from any thread. A row has a member `name`. References to rows stay valid.
template <class Row>
class Table {
  public:
    /// @param kind       what a row is, in the singular, for messages: "renderer"
    /// @param parameter  the parameter whose values the names are, for errors: "algorithm"
    Table(std::string kind, std::vector<Row> rows, std::string parameter = "")
        : kind_(std::move(kind)), parameter_(std::move(parameter)) {
        for (Row& row : rows) rows_.push_back(std::move(row));
    }

    /// All rows, in the order in which to show them; added ones come last.
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
    /// The row of that name, or null.
    const Row* look_up(std::string_view name) const {
        const std::lock_guard lock(mutex_);
        for (const Row& row : rows_)
            if (row.name == name) return &row;
        return nullptr;
    }
    /// The row of that name. Throws Error(usage) for an unknown name, with the nearest one and all that exist.
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
