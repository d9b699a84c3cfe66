// SPDX-License-Identifier: Apache-2.0
// Propagates fields in three passes: rows to frequencies; columns to frequencies, times the transfer function, to
// output rows; rows to output samples. Between the passes only one array is kept, the frequencies of the columns.
#include "hogel/propagate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <limits>
#include <mutex>
#include <numbers>
#include <utility>
#include <vector>

#include "hogel/core/rates.h"
#include "hogel/core/stop_scope.h"
#include "hogel/optics/distributed/shared_plane.h"
#include "hogel/optics/lines.h"
#include "hogel/optics/propagation/tile_plan.h"
#include "hogel/optics/propagation/transfer.h"
#include "hogel/work/ordered_reduce.h"

namespace hogel {
namespace optics::propagation {
namespace {

using Complex = std::complex<float>;

// Buffers of several lines with a padded stride.
struct Lines {
    Lines(std::size_t count, std::size_t size) : stride(stride_of(size)), values({count, stride}) {}
    std::span<Complex> operator[](std::size_t line) { return {&values(line, 0), stride}; }
    std::size_t stride;
    Array<Complex, 2> values;
};

class TileWork {
  public:
    TileWork(const FieldSource& source, const TilePlan& plan, const PropagateOptions& options, const Progress& progress)
        : source_(source),
          plan_(plan),
          options_(options),
          progress_(progress),
          transfer_(plan),
          group_rows_(source.alignment() * std::max<std::size_t>(block_lines / source.alignment(), 1)),
          frequencies_(std::max(plan.y.field.count, plan.y.output.count), plan.x.frequencies.count, group_rows_,
                       block_lines, options.scratch),
          field_rows_(frequencies_.local_rows(plan.y.field.count)),
          columns_(frequencies_.local_columns()),
          output_rows_(frequencies_.local_rows(plan.y.output.count)) {}

    // Writes the samples of the tile at `region` that the sink does not have yet.
    void run(FieldSink& sink, const Region& region) {
        const std::vector<distributed::LineRange> missing = missing_rows(sink, region);
        Communicator* const communicator = work::communicator_of_several();
        if ((communicator != nullptr ? communicator->sum(missing.size()) : missing.size()) == 0) return;
        blocks_ = blocks_of(field_rows_.count, group_rows_) + blocks_of(columns_.count) + missing.size();
        rows_to_frequencies();
        frequencies_.to_columns(plan_.y.field.count);
        columns();
        frequencies_.to_rows(plan_.y.output.count);
        frequencies_to_rows(sink, region, missing);
        if (communicator != nullptr) share_rows(*communicator, sink, region);
    }

  private:
    // Returns the local rows of the tile that must be written, in blocks. The blocks are the same for any number of
    // ranks, because each rank has whole groups of rows.
    std::vector<distributed::LineRange> missing_rows(FieldSink& sink, const Region& region) const {
        std::vector<distributed::LineRange> missing;
        for (std::size_t group = output_rows_.first; group < output_rows_.end(); group += group_rows_) {
            const std::size_t end = std::min(group + group_rows_, output_rows_.end());
            for (std::size_t y = group; y < end; y += block_lines) {
                const distributed::LineRange rows{y, std::min(block_lines, end - y)};
                if (!sink.has_already(part(region, rows))) missing.push_back(rows);
            }
        }
        return missing;
    }

    static Region part(const Region& region, const distributed::LineRange& rows) {
        return {region.x0, region.y0 + rows.first, region.width, rows.count};
    }

    void report_block() {
        const std::lock_guard lock(reporting_);
        progress_.report(static_cast<double>(++done_) / static_cast<double>(blocks_));
    }

    void rows_to_frequencies() {
        const std::size_t width = plan_.x.field.count;
        frequencies_.begin_rows(plan_.y.field.count);
        const LineTransform inward(plan_.x.field, plan_.x.frequencies, -1, plan_.x.field.step, plan_.x.inward);
        work::parallel_for(blocks_of(field_rows_.count, group_rows_), [&](std::size_t block) {
            const std::size_t y0 = field_rows_.first + block * group_rows_,
                              rows = std::min(group_rows_, field_rows_.end() - y0);
            Array<Complex, 2> samples({rows, width});
            source_.read({0, y0, width, rows}, options_.look, samples);
            Lines line(1, inward.buffer());
            for (std::size_t y = 0; y < rows; ++y) {
                std::copy_n(&samples(y, 0), width, line[0].data());
                inward(line[0]);
                frequencies_.put_row(y0 + y, line[0].data());
            }
            report_block();
        });
    }

    void columns() {
        const AxisPlan& y = plan_.y;
        const LineTransform inward(y.field, y.frequencies, -1, y.field.step, y.inward);
        const LineTransform outward(y.frequencies, y.output, 1, 1 / (plan_.x.period * y.period), y.outward);
        const distributed::LocalColumns field_columns = frequencies_.in_columns(y.field.count),
                                        output_columns = frequencies_.in_columns(y.output.count);
        const std::size_t blocks = blocks_of(columns_.count);
        std::vector<Transfer::Energy> energies(blocks);
        work::parallel_for(blocks, [&](std::size_t block) {
            const std::size_t x0 = columns_.first + block * block_lines,
                              count = std::min(block_lines, columns_.end() - x0);
            Lines lines(count, std::max(inward.buffer(), outward.buffer()));
            for (std::size_t row = 0; row < y.field.count; ++row)
                for (std::size_t i = 0; i < count; ++i) lines[i][row] = field_columns(row, x0 + i);
            for (std::size_t i = 0; i < count; ++i) {
                inward(lines[i]);
                const std::span<Complex> frequencies = lines[i].first(y.frequencies.count);
                if (plan_.min_cosine > 0) {
                    const Transfer::Energy energy = transfer_.energy(x0 + i, frequencies);
                    energies[block].all += energy.all;
                    energies[block].grazing += energy.grazing;
                }
                transfer_.multiply(x0 + i, frequencies);
                outward(lines[i]);
            }
            for (std::size_t row = 0; row < y.output.count; ++row)
                for (std::size_t i = 0; i < count; ++i) output_columns(row, x0 + i) = lines[i][row];
            report_block();
        });
        require_little_grazing_light(energies);
    }

    // The energies of all ranks are added in the order of the columns: the sum is the same for any number of ranks.
    void require_little_grazing_light(std::vector<Transfer::Energy> energies) const {
        double all = 0, grazing = 0;
        if (Communicator* const communicator = work::communicator_of_several()) {
            work::MessageWriter local_energies;
            local_energies.put(energies);
            energies.clear();
            for (const std::string& bytes : distributed::all_of(*communicator, local_energies.take())) {
                work::MessageReader message(bytes);
                std::ranges::copy(message.get_vector<Transfer::Energy>(), std::back_inserter(energies));
            }
        }
        for (const Transfer::Energy& energy : energies) {
            all += energy.all;
            grazing += energy.grazing;
        }
        if (!(grazing > options_.max_error * options_.max_error * all)) return;  // also for a dark field
        throw Error(ErrorCode::usage,
                    fmt::format("{:.2g} of the field's amplitude travels within {:.2g} degrees of its plane, too far "
                                "sideways to compute; expected at most {:.2g}, or a greater distance",
                                std::sqrt(grazing / all), std::asin(plan_.min_cosine) * 180 / std::numbers::pi,
                                options_.max_error));
    }

    void frequencies_to_rows(FieldSink& sink, const Region& region, std::span<const distributed::LineRange> blocks) {
        const LineTransform outward(plan_.x.frequencies, plan_.x.output, 1, 1, plan_.x.outward);
        work::parallel_for(blocks.size(), [&](std::size_t block) {
            const distributed::LineRange& rows = blocks[block];
            Lines line(1, outward.buffer());
            Array<Complex, 2> samples({rows.count, region.width});
            for (std::size_t y = 0; y < rows.count; ++y) {
                frequencies_.get_row(rows.first + y, line[0].data());
                outward(line[0]);
                std::copy_n(line[0].data(), region.width, &samples(y, 0));
            }
            sink.write(part(region, rows), samples);
            report_block();
        });
    }

    // All-gathers the rows of a tile if every rank has the output in its own memory.
    void share_rows(Communicator& communicator, FieldSink& sink, const Region& region) {
        const View<Complex, 2> output = sink.in_memory();
        if (output.size() == 0) return;
        for (std::size_t rank = 0; rank < communicator.size(); ++rank) {
            const distributed::LineRange rows =
                distributed::lines_of(rank, communicator.size(), region.height, group_rows_);
            for (std::size_t y = rows.first; y < rows.end(); ++y) {
                Complex* const samples = &output(region.y0 + y, region.x0);
                const std::size_t bytes = region.width * sizeof(Complex);
                if (rank != communicator.rank())
                    std::memcpy(static_cast<void*>(samples), communicator.receive_from(rank).data(), bytes);
                else
                    for (std::size_t receiver = 0; receiver < communicator.size(); ++receiver)
                        if (receiver != rank)
                            communicator.send_to(receiver, {reinterpret_cast<const char*>(samples), bytes});
            }
        }
    }
    const FieldSource& source_;
    const TilePlan& plan_;
    const PropagateOptions& options_;
    const Progress& progress_;
    Transfer transfer_;
    std::size_t group_rows_;                // number of rows that are read together
    distributed::SharedPlane frequencies_;  // [row][frequency], first rows of the field, then of the output
    distributed::LineRange field_rows_, columns_, output_rows_;  // of this rank
    std::size_t blocks_ = 0, done_ = 0;
    std::mutex reporting_;
};

// Writes zeros outside the illuminated region. Ranks share the blocks, unless each has the output in its own memory.
void write_dark(FieldSink& sink, const Grid& output, const Region& illuminated) {
    const std::size_t right = illuminated.x0 + illuminated.width, below = illuminated.y0 + illuminated.height;
    const Region parts[] = {{0, 0, output.width, illuminated.y0},
                            {0, illuminated.y0, illuminated.x0, illuminated.height},
                            {right, illuminated.y0, output.width - right, illuminated.height},
                            {0, below, output.width, output.height - below}};
    Communicator* const communicator = work::communicator_of_several();
    const bool writes_all = communicator == nullptr || sink.in_memory().size() > 0;
    constexpr std::size_t block_samples = 1 << 18;
    std::size_t block = 0;
    for (const Region& part : parts) {
        if (part.samples() == 0) continue;
        const std::size_t rows = std::max<std::size_t>(block_samples / part.width, 1);
        for (std::size_t y = 0; y < part.height; y += rows, ++block) {
            core::throw_if_stopped();
            const Region block_region{part.x0, part.y0 + y, part.width, std::min(rows, part.height - y)};
            if ((writes_all || block % communicator->size() == communicator->rank()) && !sink.has_already(block_region))
                sink.write(block_region, Array<Complex, 2>({block_region.height, block_region.width}));
        }
    }
}

// A division of the output into equal tiles; the last ones of a row and a column may be smaller.
struct Tiling {
    Grid output;
    std::size_t across = 1, down = 1;

    Region tile(std::size_t column, std::size_t row) const {
        const auto range = [](std::size_t i, std::size_t n, std::size_t samples) {
            return std::pair(i * samples / n, (i + 1) * samples / n);
        };
        const auto [x0, x1] = range(column, across, output.width);
        const auto [y0, y1] = range(row, down, output.height);
        return {x0, y0, x1 - x0, y1 - y0};
    }
    // Returns the plans of the corner tiles, which are the most oblique, and of a central tile, because corners may be
    // dark.
    std::vector<TilePlan> sample_plans(const FieldGrid& field, double distance) const {
        std::vector<TilePlan> plans{plan_tile(field, distance, part(output, tile(across / 2, down / 2)))};
        for (const std::size_t row : {std::size_t{0}, down - 1})
            for (const std::size_t column : {std::size_t{0}, across - 1})
                plans.push_back(plan_tile(field, distance, part(output, tile(column, row))));
        return plans;
    }
};

// Chooses a tiling. A tile needs fewer frequencies, because less light leads to it, but transforms the whole field.
Tiling tiling_of(const FieldGrid& field, double distance, const Grid& output) {
    const auto operations = [&](const Tiling& tiling) {
        double worst = 0;
        for (const TilePlan& plan : tiling.sample_plans(field, distance)) worst = std::max(worst, plan.operations());
        return worst * static_cast<double>(tiling.across) * static_cast<double>(tiling.down);
    };
    Tiling best{output};
    double best_operations = operations(best);
    for (Tiling next = best; next.across < output.width || next.down < output.height;) {
        next.across = std::min(2 * next.across, output.width);
        next.down = std::min(2 * next.down, output.height);
        const double total = operations(next);
        // The number of operations increases monotonically beyond the best size.
        if (total > 2 * best_operations) break;
        if (total < 0.7 * best_operations) {
            best_operations = total;
            best = next;
        }
    }
    return best;
}

Grid output_of(const FieldGrid& field, double distance, const PropagateOptions& options) {
    validate(field, ErrorCode::usage, "propagated field");
    if (!std::isfinite(distance))
        throw Error(ErrorCode::usage, "distance",
                    fmt::format("a field cannot be propagated by {} m; the distance must be finite", distance));
    const Grid output = options.output.value_or(field.plane);
    validate(FieldGrid{output, field.wavelength}, ErrorCode::usage, "output of the propagation");
    if (!std::isfinite(output.center_x) || !std::isfinite(output.center_y))
        throw Error(ErrorCode::usage, "offset_x, offset_y", "the centre of the propagation's output must be finite");
    return output;
}

bool is_identity(const FieldGrid& field, double distance, const Grid& output) {
    return distance == 0 && output == field.plane;
}

void require_accuracy(double error, double max_error) {
    if (error <= max_error) return;
    throw Error(ErrorCode::usage,
                fmt::format("the predicted relative error is {:.2g}; at most {:.2g} is accepted", error, max_error));
}

}  // namespace
}  // namespace optics::propagation

using namespace optics;
using namespace optics::propagation;

PropagationMethod propagation_method(const FieldGrid& field, double distance, const PropagateOptions& options) {
    const Grid output = output_of(field, distance, options);
    const double half = 0.5 * std::max(field.plane.size_x(), field.plane.size_y());
    PropagationMethod method;
    method.fresnel_number =
        distance == 0 ? std::numeric_limits<double>::infinity() : half * half / (field.wavelength * std::abs(distance));
    method.name = "identity";
    if (is_identity(field, distance, output)) return method;
    const Tiling tiling = tiling_of(field, distance, part(output, illuminated_region(field, distance, output)));
    method.name = "fft";
    method.tiles_x = tiling.across;
    method.tiles_y = tiling.down;
    for (const TilePlan& plan : tiling.sample_plans(field, distance)) {
        method.frequencies_x = std::max(method.frequencies_x, plan.x.frequencies.count);
        method.frequencies_y = std::max(method.frequencies_y, plan.y.frequencies.count);
        method.bytes = std::max(method.bytes, plan.bytes());
        method.operations = std::max(method.operations, plan.operations());
        method.error = std::max(method.error, Transfer(plan).error());
        for (const AxisPlan* axis : {&plan.x, &plan.y})
            if (axis->inward == 0 || axis->outward == 0) method.name = "chirp-z";
    }
    method.operations *= static_cast<double>(tiling.across * tiling.down);
    require_accuracy(method.error, options.max_error);
    return method;
}

Plan plan_propagation(std::span<const FieldGrid> fields, double distance, const PropagateOptions& options) {
    Plan plan;
    for (const FieldGrid& field : fields) {
        const PropagationMethod method = propagation_method(field, distance, options);
        const auto in_memory = static_cast<double>(options.scratch.memory);
        const double result =
            static_cast<double>(options.output.value_or(field.plane).samples()) * sizeof(std::complex<float>);
        // Besides the work array, every thread transforms lines, padded to about three times their frequencies. Pages
        // of a mapped file stay in memory only while there is room.
        const double lines = 3 * static_cast<double>(block_lines * thread_count()) *
                             static_cast<double>(std::max(method.frequencies_x, method.frequencies_y)) *
                             sizeof(std::complex<float>);
        plan.memory = std::max(plan.memory, std::min(method.bytes, in_memory) + lines);
        plan.disk += result + (method.bytes > in_memory ? method.bytes : 0);
        plan.seconds += core::rates::on_all_threads(method.operations * core::rates::propagation_operation);
    }
    return plan;
}

void propagate(const FieldSource& source, double distance, FieldSink& sink, const PropagateOptions& options,
               const Progress& progress) {
    const core::StopScope scope(progress);
    const FieldGrid& field = source.grid();
    const Grid output = output_of(field, distance, options);
    if (is_identity(field, distance, output)) return copy(source, sink, options.look, progress);
    const Region illuminated = illuminated_region(field, distance, output);
    write_dark(sink, output, illuminated);
    const Tiling tiling = tiling_of(field, distance, part(output, illuminated));
    const std::size_t tiles = tiling.across * tiling.down;
    for (std::size_t i = 0; i < tiles; ++i) {
        Region region = tiling.tile(i % tiling.across, i / tiling.across);
        const TilePlan plan = plan_tile(field, distance, part(tiling.output, region));
        require_accuracy(Transfer(plan).error(), options.max_error);
        region.x0 += illuminated.x0;
        region.y0 += illuminated.y0;
        TileWork(source, plan, options, progress.part(i, tiles)).run(sink, region);
    }
    sink.finish();
    progress.report(1);
}

Field propagate(const FieldSource& source, double distance, const PropagateOptions& options, const Progress& progress) {
    Field result({output_of(source.grid(), distance, options), source.grid().wavelength});
    result.set_provenance(source.provenance());
    propagate(source, distance, result, options, progress);
    return result;
}

}  // namespace hogel
