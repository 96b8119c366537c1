#include "compress/form_options.h"

#include <gtest/gtest.h>

#include <map>

#include "build/median.h"
#include "common/test_scenes.h"
#include "compress/candidates.h"

namespace bvhio {
namespace {

TEST(FormOptions, areReadFromWords) {
    EXPECT_EQ(parseEncodeOptions("aabb", ""), EncodeOptions(AabbForm::Options{}));
    EXPECT_EQ(parseEncodeOptions("quantized", "--bits 6"), EncodeOptions(QuantizedForm::Options{.bits = 6}));
    EXPECT_EQ(parseEncodeOptions("two-level", "--blas-size 16  --tlas-form aabb --blas-form ssh"),
              EncodeOptions(TwoLevelForm::Options{
                  .tlasForm = TlasForm::aabb, .blasForm = BlasForm::ssh, .blasSize = 16}));
    EXPECT_EQ(parseEncodeOptions("mvh", "--zeta 0.5,0.25 --mvh-build paper"),
              EncodeOptions(MvhForm::Options{.zeta = 0.5f, .zetaOfBoth = 0.25f, .build = MvhBuild::paper}));
}

TEST(FormOptions, areRefusedInOneLine) {
    const std::pair<std::string_view, std::string_view> wrong[] = {
        {"nonsense", ""},          {"ssh", "--bits 8"},
        {"quantized", "--bits 9"}, {"quantized", "--bits"},
        {"quantized", "--bits x"}, {"quantized", "bits 8"},
        {"mvh", "--zeta 0.3,0.6"}, {"two-level", "--tlas-form ssh"}};
    for (const auto& [form, words] : wrong) {
        try {
            parseEncodeOptions(form, words);
            ADD_FAILURE() << form << ' ' << words;
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::usage);
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
        }
    }
}

TEST(FormOptions, ofOneFormAreNotTakenByAnother) {
    const Scene scene = test::sphereScene(6, 4);
    const Bvh bvh = buildMedian(scene, {});
    EXPECT_THROW(choose(forms(), "form", "ssh").function(scene, bvh, QuantizedForm::Options{}), Error);
    EXPECT_NO_THROW(choose(forms(), "form", "ssh").function(scene, bvh, {}));
}

// What --help and provenance are made of.
TEST(FormOptions, areDescribedOnceAndHaveTheDefaultsThatTheyState) {
    std::map<std::string_view, int> described;
    for (const FormChoice& form : forms())
        visitForm(form.name, [&]<class Form>(std::type_identity<Form>) {
            const typename Form::Options defaults;
            for (const auto& option : Form::optionTable()) {
                SCOPED_TRACE(std::string(form.name).append(" ").append(option.name));
                described[option.name] += option.part.empty();
                EXPECT_EQ(option.help.empty(), !option.part.empty());
                const OptionValue value = option.get(defaults);
                if (option.kind == OptionKind::number) {
                    EXPECT_GE(value.number, option.min);
                    EXPECT_LE(value.number, option.max);
                }
                typename Form::Options again;
                option.set(again, value);
                EXPECT_EQ(again, defaults);
                EXPECT_NE(defaultText(option), "");
            }
        });
    for (const auto& [name, count] : described) EXPECT_EQ(count, 1) << name;
}

// Chosen encodings are made again from their words.
TEST(FormOptions, ofCandidatesAreTheirWords) {
    for (const EncodingCandidate& candidate : encodingCandidates())
        EXPECT_EQ(candidate.options, parseEncodeOptions(candidate.form, candidate.parameters))
            << candidate.name();
}

}  // namespace
}  // namespace bvhio
