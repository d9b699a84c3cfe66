// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <complex>
#include <memory>
#include <utility>
#include <vector>

#include "hogel/array.h"
#include "hogel/export.h"
#include "hogel/geometry.h"
#include "hogel/progress.h"
#include "hogel/provenance.h"

namespace hogel {

namespace stereogram {
class Stereogram;
}

/// The sampling and the wavelength of a monochromatic complex field F on the plane z = 0. The time factor is e^{-iωt}:
/// a wave that travels in direction n is e^{+ik n·x}. |F|² is normalised to the radiance of the light field
/// (docs/notation.md, section 3).
struct FieldGrid {
    Grid plane;             ///< samples F[y][x]
    double wavelength = 0;  ///< metres

    friend bool operator==(const FieldGrid&, const FieldGrid&) = default;
};

/// Throws Error(code), naming `what` and the member that is wrong: zero samples, a pitch or a wavelength that is not
/// positive and finite, a wavelength above 0.1 mm, or more samples than can be addressed.
HOGEL_API void validate(const FieldGrid& grid, ErrorCode code, const std::string& what);

/// Throws Error(usage) if the region is empty or leaves the grid, or if `array` is not (height, width) of the region.
HOGEL_API void validate(const Region& region, const FieldGrid& grid, const Shape<2>& array);

/// A source of fields: memory, a file, or a synthesis on demand. A source may offer several looks: statistically
/// independent fields (other random phases) of the same object, whose photographs are averaged against speckle.
/// read() may be called from several threads at once; the value of a sample does not depend on the region that is read.
class HOGEL_API FieldSource {
  public:
    virtual ~FieldSource() = default;
    virtual const FieldGrid& grid() const = 0;
    virtual std::size_t looks() const { return 1; }
    /// Where the field comes from: the provenance stored in its file, or that of the light field that it shows.
    virtual const Provenance& provenance() const;
    /// Regions whose positions and sizes are multiples of this number of samples are read without repeated work.
    virtual std::size_t alignment() const { return 1; }
    /// How many samples beyond each side of a region are computed for it and not kept: where windows overlap.
    virtual std::size_t overlap() const { return 0; }
    /// Fills out[y][x] (shape: height × width of the region) with the region's samples in look number `look`.
    virtual void read(const Region& region, std::size_t look, View<std::complex<float>, 2> out) const = 0;
    /// For the library: this field as a stereogram that is made on demand, from whose hogels photograph() computes
    /// light; null for other fields, also for those that a program defines.
    virtual const stereogram::Stereogram* stereogram() const { return nullptr; }
};

/// The fields of a hologram, one for each wavelength. Ownership is shared, so copies are cheap.
using Fields = std::vector<std::shared_ptr<const FieldSource>>;

/// A destination of fields. write() may be called from several threads at once, once for each sample.
class HOGEL_API FieldSink {
  public:
    virtual ~FieldSink() = default;
    virtual void write(const Region& region, View<const std::complex<float>, 2> values) = 0;
    /// The storage of all samples, [y][x], if the field is completely in memory; a writer may fill it instead of
    /// calling write(). Otherwise no elements.
    virtual View<std::complex<float>, 2> in_memory() { return {}; }
    /// Whether the sink continues an interrupted run in which exactly this region was written; then it counts as
    /// written, and the caller skips it.
    virtual bool has_already(const Region&) { return false; }
    /// Called once after the last region; a file appears under its own name only now.
    virtual void finish() {}
};

/// A field that is completely in memory, both source and sink.
class HOGEL_API Field final : public FieldSource, public FieldSink {
  public:
    explicit Field(const FieldGrid& grid);
    const FieldGrid& grid() const override { return grid_; }
    void read(const Region& region, std::size_t look, View<std::complex<float>, 2> out) const override;
    void write(const Region& region, View<const std::complex<float>, 2> values) override;
    View<std::complex<float>, 2> in_memory() override { return samples; }
    const Provenance& provenance() const override { return provenance_; }
    void set_provenance(Provenance provenance) { provenance_ = std::move(provenance); }

    Array<std::complex<float>, 2> samples;  ///< [y][x]

  private:
    FieldGrid grid_;
    Provenance provenance_;
};

/// Streams one look of a field from a source to a sink, region by region on all threads, then calls finish().
HOGEL_API void copy(const FieldSource& source, FieldSink& sink, std::size_t look = 0, const Progress& progress = {});

}  // namespace hogel
