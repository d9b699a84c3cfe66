// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <complex>

#include "hogel/error.h"
#include "hogel/io/arrays/test_field_files.h"
#include "hogel/requests.h"
#include "hogel/words/test_texts.h"

namespace hogel {
namespace {

using Texts = std::vector<std::pair<std::string, std::string>>;

// Parameters of a field, parsed from texts.
struct AskedField {
    FieldParameters field;
    Parameters table;

    explicit AskedField(const Texts& texts) {
        field.declare(table);
        field.declare_reconstruction(table);
        for (const auto& [name, text] : texts) table.look_up(name)->read_value(text, name);
    }
};

class FieldParametersTest : public io::arrays::FieldFiles {
  protected:
    FieldParametersTest() {
        Array<std::complex<float>, 2> wave({24, 32});
        for (std::size_t y = 0; y < 24; ++y)
            for (std::size_t x = 0; x < 32; ++x)
                wave(y, x) = std::polar(1 + 0.1f * float(y), 1.5f * float(x) + 0.02f * float(x * y));
        write_npy(file_, View<const std::complex<float>, 2>(wave));
    }

    std::string file_ = (directory_ / "wave.npy").string();
    Texts sampling_{{"pitch", "4um"}, {"wavelength", "532nm"}};
};

TEST_F(FieldParametersTest, those_that_act_open_the_same_image_again) {
    const std::vector<Texts> cases{{},
                                   {{"conjugate", "yes"}},
                                   {{"order", "+1"}, {"aperture", "0.1"}},
                                   {{"order", "0.25,0"}, {"reference-source", "0,1,-20mm"}},
                                   {{"reconstruct", "fourier"}, {"focal", "100mm"}},
                                   {{"reconstruct", "fresnel"}, {"focal", "-30mm"}, {"order", "0"}}};
    for (const Texts& texts : cases) {
        Texts all = sampling_;
        all.insert(all.end(), texts.begin(), texts.end());
        AskedField first(all);
        const OpenedFields opened = first.field.open_and_reconstruct(file_, first.table);
        const Metadata acting = first.table.acting();
        for (const auto& each : all) EXPECT_EQ(std::ranges::count(acting, each), 1) << each.first;
        AskedField again(acting);
        const OpenedFields same = again.field.open_and_reconstruct(file_, again.table);
        EXPECT_EQ(again.table.acting(), acting);
        EXPECT_EQ(same.notes, opened.notes);
        ASSERT_EQ(same.fields.size(), 1u);
        EXPECT_EQ(same.fields[0]->grid(), opened.fields[0]->grid());
        const auto a = io::arrays::all_of(*opened.fields[0]), b = io::arrays::all_of(*same.fields[0]);
        EXPECT_TRUE(std::ranges::equal(a.elements(), b.elements())) << (texts.empty() ? "" : texts.front().first);
    }
}

TEST_F(FieldParametersTest, errors_name_the_parameter) {
    const std::vector<std::pair<Texts, std::string>> cases{
        {{{"wavelength", "532nm"}}, "pitch"},
        {{{"pitch", "4um"}}, "wavelength"},
        {{{"pitch", "4um"}, {"wavelength", "633nm,532nm"}}, "wavelength"},
        {{{"pitch", "4um"}, {"wavelength", "532nm"}, {"variable", "a"}}, "variable"},
        {{{"pitch", "4um"}, {"wavelength", "532nm"}, {"zero", "x"}}, "zero"},
        {{{"pitch", "4um"}, {"wavelength", "532nm"}, {"order", "2"}}, "order"},
        {{{"pitch", "4um"}, {"wavelength", "532nm"}, {"aperture", "-1"}}, "aperture"},
        {{{"pitch", "4um"}, {"wavelength", "532nm"}, {"focal", "1mm"}}, "focal"},
        {{{"pitch", "4um"}, {"wavelength", "532nm"}, {"reconstruct", "fourier"}}, "focal"},
        {{{"pitch", "4um"}, {"wavelength", "532nm"}, {"values", "phase"}, {"phase-code", "odka"}}, "phase_code"}};
    for (const auto& [texts, parameter] : cases) {
        AskedField asked(texts);
        try {
            asked.field.open_and_reconstruct(file_, asked.table);
            ADD_FAILURE() << parameter;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::usage);
            EXPECT_EQ(error.parameter(), parameter) << error.what();
        }
    }
}

TEST(PropagateParameters, resolved_ones_have_the_same_output) {
    const Grid field{64, 48, 4e-6, 4e-6, 1e-5, -2e-5};
    for (const Texts& texts : {Texts{}, Texts{{"output-samples", "10x20"}, {"offset-x", "1mm"}},
                               Texts{{"output-pitch", "2um"}, {"offset-y", "-1um"}}}) {
        FromTexts<PropagateParameters> first(texts);
        const Grid output = *first.values.options(field).output;
        first.values.resolve(output);
        EXPECT_EQ(FromTexts<PropagateParameters>(first.table.acting()).values.options(field).output, output);
    }
    EXPECT_EQ(PropagateParameters().options(field).output, field);
}

}  // namespace
}  // namespace hogel
