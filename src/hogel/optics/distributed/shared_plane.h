// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <complex>
#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "hogel/communicator.h"
#include "hogel/core/paged_array.h"
#include "hogel/work/chunks.h"
#include "hogel/work/ordered_reduce.h"

namespace hogel::optics::distributed {

/// Lines [first, first + count) of a plane.
struct LineRange {
    std::size_t first = 0, count = 0;
    std::size_t end() const { return first + count; }
};

/// Lines that are in both.
LineRange common_lines(const LineRange& a, const LineRange& b);

/// The lines of one of several processes: about equally many, in groups of `together`.
LineRange lines_of(std::size_t process, std::size_t processes, std::size_t lines, std::size_t together);

/// Gives all processes of a team the lines that each has made of an array that each has room for.
/// @param length  of a line
/// @param made    the lines that a process has made
template <class Value, class Made>
void share_lines(Communicator& communicator, Value* lines, std::size_t length, const Made& made) {
    const auto lines_of_process = [&](std::size_t process) {
        const LineRange some = made(process);
        return std::span<Value>(lines + some.first * length, some.count * length);
    };
    for (std::size_t process = 0; process < communicator.size(); ++process)
        if (process != communicator.rank())
            work::send_in_chunks<Value>(communicator, process, lines_of_process(communicator.rank()));
    for (std::size_t process = 0; process < communicator.size(); ++process)
        if (process != communicator.rank()) work::receive_in_chunks(communicator, process, lines_of_process(process));
}

/// Places in the own columns of a plane, [row][column].
class LocalColumns {
  public:
    LocalColumns() = default;
    LocalColumns(std::vector<std::complex<float>*> rows, std::size_t first) : rows_(std::move(rows)), first_(first) {}
    /// The row's places in other own columns follow it.
    std::complex<float>& operator()(std::size_t y, std::size_t x) const { return rows_[y][x - first_]; }

  private:
    std::vector<std::complex<float>*> rows_;  // of each row, the place in the first own column
    std::size_t first_ = 0;
};

/// A plane of complex numbers that is transformed along rows and along columns in turn. Alone, a process has it in one
/// array. The processes of a team have rows and then columns or the other way round, and exchange what crosses: each of
/// them keeps one N-th part, in place. Each process works on its own lines.
class SharedPlane {
  public:
    SharedPlane() = default;
    /// In columns, with any samples. The number of rows may change while the plane is in columns.
    /// @param rows           the largest number
    /// @param block_rows  rows that a process has together, as far as the last ones allow
    SharedPlane(std::size_t rows, std::size_t columns, std::size_t block_rows, std::size_t block_columns,
                const ScratchOptions& scratch, Communicator* communicator = hogel::communicator());

    std::size_t rows() const { return rows_; }
    std::size_t columns() const { return columns_; }
    LineRange local_rows(std::size_t rows) const { return lines_of(rank_, size_, rows, block_rows_); }
    LineRange local_columns() const { return lines_of(rank_, size_, columns_, block_columns_); }

    /// To be called before the first rows, or columns, are written.
    void begin_rows(std::size_t rows) { rows_ = rows; }
    void begin_columns(std::size_t rows);

    /// While the plane is in rows: writes and reads an own row.
    void put_row(std::size_t y, const std::complex<float>* from);
    void get_row(std::size_t y, std::complex<float>* to) const;

    /// While it is in columns: the places of so many rows. Writing those of other numbers of rows overwrites only what
    /// is in the same column.
    LocalColumns in_columns(std::size_t rows);
    std::complex<float>& at(std::size_t y, std::size_t x) { return places_(y, x); }
    const std::complex<float>& at(std::size_t y, std::size_t x) const { return places_(y, x); }

    /// Alone: all of it.
    View<std::complex<float>, 2> view() { return {samples_.view().data(), {rows_, columns_}}; }
    View<const std::complex<float>, 2> view() const { return {samples_.view().data(), {rows_, columns_}}; }

    /// Both wait for all processes, and throw Error(cancelled) if one has failed.
    /// @param rows  the plane's number of rows from now on
    void to_columns(std::size_t rows);
    void to_rows(std::size_t rows);

  private:
    std::size_t block_size(std::size_t process, bool columns) const;
    void transpose(bool columns);

    Communicator* communicator_ = nullptr;
    std::size_t rank_ = 0, size_ = 1;
    std::size_t rows_ = 0, columns_ = 0, block_rows_ = 1, block_columns_ = 1;
    // A block for each process: in rows the own rows' places in its columns, in columns its rows' in the own columns.
    core::PagedArray samples_;
    std::vector<std::size_t> block_starts_;
    LocalColumns places_;
};

/// Gives processes of a team rows of a plane that all have by rows, as lines_of() of these says. Few messages are under
/// way. All call it with the same arguments.
/// @param wanted   the rows that a process gets, of any other and of itself
/// @param get_row  writes an own row
/// @param place    where a row goes that this process gets
void send_rows(Communicator& communicator, const Shape<2>& shape, std::size_t block_rows,
               const std::function<LineRange(std::size_t process)>& wanted,
               const std::function<void(std::size_t y, std::complex<float>* to)>& get_row,
               const std::function<std::complex<float>*(std::size_t y)>& place);

/// What all processes have given, in the order of their numbers, in each of them.
std::vector<std::string> all_of(Communicator& communicator, const std::string& own);

}  // namespace hogel::optics::distributed
