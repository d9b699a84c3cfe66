// SPDX-License-Identifier: Apache-2.0
#include "hogel/camera/band_sources.h"

#include "hogel/camera/hogel_spectra/hogel_band_source.h"
#include "hogel/camera/narrow_band/narrow_band.h"

namespace hogel::camera {
namespace {

// Source of pupil bands from the samples of a field.
class SampledBandSource final : public PupilBandSource {
  public:
    SampledBandSource(const FieldSource& field, std::span<const Viewpoint> viewpoints) : field_(field) {
        for (const Viewpoint& viewpoint : viewpoints)
            bands_.emplace_back(field.grid(), viewpoint.position, viewpoint.pupil);
    }
    const narrow_band::BandGrid& band(std::size_t viewpoint) const override { return bands_[viewpoint]; }
    // Bands are summed as floats before they are packed.
    double bytes_per_look(std::size_t viewpoint) const override {
        return static_cast<double>(sizeof(std::complex<float>) * bands_[viewpoint].plane.samples());
    }
    PackedBands synthesize(std::size_t first_look, std::size_t looks, const Progress& progress) const override {
        PackedBands packed;
        for (auto& looks_of_viewpoint :
             narrow_band::compute_narrow_bands(field_, bands_, first_look, looks, progress)) {
            packed.emplace_back();
            for (Array<std::complex<float>, 2>& band : looks_of_viewpoint) {
                packed.back().emplace_back(band);
                band = {};
            }
        }
        return packed;
    }

  private:
    const FieldSource& field_;
    std::vector<narrow_band::NarrowBand> bands_;
};

}  // namespace

std::unique_ptr<PupilBandSource> make_band_source(const FieldSource& hologram, const Region& part,
                                                  const FieldSource& window, std::span<const Viewpoint> viewpoints,
                                                  BandSource source, const hogel_spectra::WaveCache* wave_cache) {
    std::unique_ptr<PupilBandSource> bands;
    if (source != BandSource::samples && hologram.stereogram() != nullptr)
        bands = hogel_spectra::make_hogel_band_source(*hologram.stereogram(), part, viewpoints, wave_cache);
    if (!bands && source == BandSource::hogel_spectra)
        throw Error(ErrorCode::usage, "camera",
                    "photographs from hogel spectra need a stereogram that is made on demand by a method with known "
                    "spectra, and a pupil band of at most a quarter of its samples; use samples for others");
    if (!bands) bands = std::make_unique<SampledBandSource>(window, viewpoints);
    return bands;
}

}  // namespace hogel::camera
