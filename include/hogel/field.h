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

/// Sampling and wavelength of a monochromatic complex field F on the plane z = 0. The time factor is e^{-iωt}: a wave
/// in direction n is e^{+ik n·x}. |F|² is normalised to the radiance of the light field (docs/notation.md, section 3).
struct FieldGrid {
    Grid plane;             ///< samples F[y][x]
    double wavelength = 0;  ///< metres

    friend bool operator==(const FieldGrid&, const FieldGrid&) = default;
};

/// Throws Error(code) for zero samples, a pitch or wavelength that is not positive and finite, a wavelength above 0.1
/// mm, or more samples than can be addressed. The message names `what` and the wrong member.
HOGEL_API void validate(const FieldGrid& grid, ErrorCode code, const std::string& what);

/// Throws Error(usage) if the region is empty or leaves the grid, or if `array` is not (height, width) of the region.
HOGEL_API void validate(const Region& region, const FieldGrid& grid, const Shape<2>& array);

/// Source of a field: memory, a file, or a synthesis on demand. A source can have several looks: statistically
/// independent speckle realisations (other random phases) of the same object. Photographs average over looks to reduce
/// speckle. read() is thread-safe, and the value of a sample does not depend on the region that is read.
class HOGEL_API FieldSource {
  public:
    virtual ~FieldSource() = default;
    virtual const FieldGrid& grid() const = 0;
    virtual std::size_t looks() const { return 1; }
    /// Returns the provenance in the field's file, or that of its light field.
    virtual const Provenance& provenance() const;
    /// Returns a number of samples: regions with multiples of it as offsets and sizes avoid repeated work.
    virtual std::size_t alignment() const { return 1; }
    /// Returns the number of extra samples computed beyond each side of a region, due to overlapping windows.
    virtual std::size_t overlap() const { return 0; }
    /// Reads a region of one look into out[y][x], of shape height × width of the region.
    virtual void read(const Region& region, std::size_t look, View<std::complex<float>, 2> out) const = 0;
    /// For internal use: returns the stereogram that computes this field on demand, so that photograph() can use its
    /// hogel spectra; null for other fields and for sources that a program defines.
    virtual const stereogram::Stereogram* stereogram() const { return nullptr; }
};

/// The fields of a hologram, one per wavelength. Ownership is shared, so copies are cheap.
using Fields = std::vector<std::shared_ptr<const FieldSource>>;

/// Destination of a field. write() is thread-safe; each sample is written once.
class HOGEL_API FieldSink {
  public:
    virtual ~FieldSink() = default;
    virtual void write(const Region& region, View<const std::complex<float>, 2> values) = 0;
    /// Returns the storage of all samples, [y][x], if the field is in memory; a writer can fill it instead of calling
    /// write(). Otherwise returns a view without elements.
    virtual View<std::complex<float>, 2> in_memory() { return {}; }
    /// Returns true if the sink continues an interrupted run that wrote exactly this region. The region then counts as
    /// written, and the caller skips it.
    virtual bool has_already(const Region&) { return false; }
    /// Completes the output after the last region. Only then does a file appear under its name. Call it once.
    virtual void finish() {}
};

/// A field in memory, both source and sink.
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

/// Copies one look of a field from a source to a sink, region by region on all threads, and calls finish().
HOGEL_API void copy(const FieldSource& source, FieldSink& sink, std::size_t look = 0, const Progress& progress = {});

}  // namespace hogel
