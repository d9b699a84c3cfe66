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

LineRange common_lines(const LineRange& a, const LineRange& b);

/// Returns the lines of a rank. Ranks have about equal numbers of lines, in whole groups of `group` adjacent lines.
LineRange lines_of(std::size_t rank, std::size_t ranks, std::size_t lines, std::size_t group);

/// All-gather: copies the lines that each rank has computed to all ranks. Every rank has room for the whole array.
/// @param length  number of values of a line
/// @param made    made(rank): the lines that a rank has computed
template <class Value, class Made>
void share_lines(Communicator& communicator, Value* lines, std::size_t length, const Made& made) {
    const auto lines_of_rank = [&](std::size_t rank) {
        const LineRange range = made(rank);
        return std::span<Value>(lines + range.first * length, range.count * length);
    };
    for (std::size_t rank = 0; rank < communicator.size(); ++rank)
        if (rank != communicator.rank())
            work::send_in_chunks<Value>(communicator, rank, lines_of_rank(communicator.rank()));
    for (std::size_t rank = 0; rank < communicator.size(); ++rank)
        if (rank != communicator.rank()) work::receive_in_chunks(communicator, rank, lines_of_rank(rank));
}

/// Access to the local columns of a plane, [row][column].
class LocalColumns {
  public:
    LocalColumns() = default;
    LocalColumns(std::vector<std::complex<float>*> rows, std::size_t first) : rows_(std::move(rows)), first_(first) {}
    /// Returns a sample. The samples of a row in adjacent local columns are contiguous.
    std::complex<float>& operator()(std::size_t y, std::size_t x) const { return rows_[y][x - first_]; }

  private:
    std::vector<std::complex<float>*> rows_;  // for each row, the address of its sample in the first local column
    std::size_t first_ = 0;
};

/// A plane of complex samples that is transformed along rows and along columns. Without a communicator it is one
/// row-major array. The ranks of a communicator each hold 1/N of it, as whole rows or as whole columns, and transpose
/// it in place by exchanging blocks. Each rank works on its local lines only.
class SharedPlane {
  public:
    SharedPlane() = default;
    /// Creates a plane in columns, with unspecified samples. While in columns, the number of rows may change.
    /// @param rows           the maximum number of rows
    /// @param block_rows     number of consecutive rows that stay on one rank; the last block may be smaller
    /// @param block_columns  likewise for columns
    SharedPlane(std::size_t rows, std::size_t columns, std::size_t block_rows, std::size_t block_columns,
                const ScratchOptions& scratch, Communicator* communicator = hogel::communicator());

    std::size_t rows() const { return rows_; }
    std::size_t columns() const { return columns_; }
    LineRange local_rows(std::size_t rows) const { return lines_of(rank_, size_, rows, block_rows_); }
    LineRange local_columns() const { return lines_of(rank_, size_, columns_, block_columns_); }

    /// Set the layout to rows, or to columns, of a plane with this number of rows. Must be called before the first row,
    /// or column, is written.
    void begin_rows(std::size_t rows) { rows_ = rows; }
    void begin_columns(std::size_t rows);

    /// Write and read a local row. Only valid while the plane is in rows.
    void put_row(std::size_t y, const std::complex<float>* from);
    void get_row(std::size_t y, std::complex<float>* to) const;

    /// Returns access to the first `rows` rows. Only valid while the plane is in columns. Writes through views with
    /// different numbers of rows overwrite only samples of the same column.
    LocalColumns in_columns(std::size_t rows);
    std::complex<float>& at(std::size_t y, std::size_t x) { return local_samples_(y, x); }
    const std::complex<float>& at(std::size_t y, std::size_t x) const { return local_samples_(y, x); }

    /// Returns the whole plane. Only valid without a communicator.
    View<std::complex<float>, 2> view() { return {samples_.view().data(), {rows_, columns_}}; }
    View<const std::complex<float>, 2> view() const { return {samples_.view().data(), {rows_, columns_}}; }

    /// Transpose the plane. Collective: both wait for all ranks, and throw Error(cancelled) if a rank has failed.
    /// @param rows  new number of rows of the plane
    void to_columns(std::size_t rows);
    void to_rows(std::size_t rows);

  private:
    std::size_t block_size(std::size_t rank, bool columns) const;
    void transpose(bool columns);

    Communicator* communicator_ = nullptr;
    std::size_t rank_ = 0, size_ = 1;
    std::size_t rows_ = 0, columns_ = 0, block_rows_ = 1, block_columns_ = 1;
    // One block per rank. In rows: the local rows, in the columns of that rank. In columns: the rows of that rank, in
    // the local columns.
    core::PagedArray samples_;
    std::vector<std::size_t> block_starts_;
    LocalColumns local_samples_;
};

/// Redistributes rows of a plane that the ranks hold by rows, as lines_of() distributes them. Keeps few messages in
/// flight, to save memory. Collective: all ranks pass the same shape, block_rows and `wanted`.
/// @param wanted       wanted(rank): the rows that a rank receives, also from itself
/// @param get_row      writes local row y to `to`
/// @param destination  destination(y): the address to which received row y is written
void send_rows(Communicator& communicator, const Shape<2>& shape, std::size_t block_rows,
               const std::function<LineRange(std::size_t rank)>& wanted,
               const std::function<void(std::size_t y, std::complex<float>* to)>& get_row,
               const std::function<std::complex<float>*(std::size_t y)>& destination);

/// All-gather: returns the strings of all ranks in the order of the ranks.
std::vector<std::string> all_of(Communicator& communicator, const std::string& local);

}  // namespace hogel::optics::distributed
