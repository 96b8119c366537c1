#include "trace/tune.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "build/median.h"
#include "common/test_scenes.h"
#include "compress/forms.h"

namespace bvhio {
namespace {

TunedEncoding row(std::string_view form, double bytes, double slowdown) {
    TunedEncoding result{{form, ""}};
    result.bytesPerPrimitive = bytes;
    result.slowdown = slowdown;
    return result;
}

struct Rows {
    std::vector<TunedEncoding> rows{row("plain", 32, 1), row("fast", 36, 0.9), row("small", 8, 1.2),
                                    row("poor", 9, 1.3), row("tiny", 2, 4),    row("fails", 1, 0.5)};
    Rows() { rows.back().refusal = "holds \"no\" more, sorry"; }
};

TEST(Tune, choosesTheFastestThatIsSmallEnough) {
    const Rows r;
    EXPECT_EQ(fastestWithin(r.rows, 100), &r.rows[1]);
    EXPECT_EQ(fastestWithin(r.rows, 35), &r.rows[0]);
    EXPECT_EQ(fastestWithin(r.rows, 10), &r.rows[2]);
    EXPECT_EQ(fastestWithin(r.rows, 2), &r.rows[4]);
    EXPECT_EQ(fastestWithin(r.rows, 1.9), nullptr);
}

TEST(Tune, choosesTheSmallestThatIsFastEnough) {
    const Rows r;
    EXPECT_EQ(smallestWithin(r.rows, 100), &r.rows[4]);
    EXPECT_EQ(smallestWithin(r.rows, 3.9), &r.rows[2]);
    EXPECT_EQ(smallestWithin(r.rows, 1), &r.rows[0]);
    EXPECT_EQ(smallestWithin(r.rows, 0.95), &r.rows[1]);
    EXPECT_EQ(smallestWithin(r.rows, 0.5), nullptr);
}

TEST(Tune, knowsWhichRowsAreDominated) {
    const Rows r;
    for (const TunedEncoding& each : r.rows)
        EXPECT_EQ(isDominated(each, r.rows), each.candidate.form == "poor") << each.candidate.form;
    const std::vector<TunedEncoding> equal{row("a", 8, 1), row("b", 8, 1)};
    EXPECT_FALSE(isDominated(equal[0], equal));
}

TEST(Tune, writesTheTableAsCsv) {
    const Rows r;
    const std::string csv = csvOf(r.rows, &r.rows[2]);
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 7);
    EXPECT_NE(csv.find("\nplain,,32,0,0,0,1,1,1,frontier\n"), std::string::npos);
    EXPECT_NE(csv.find("\nsmall,,8,0,0,0,1.2,1,1,chosen\n"), std::string::npos);
    EXPECT_NE(csv.find("\npoor,,9,0,0,0,1.3,1,1,dominated\n"), std::string::npos);
    EXPECT_NE(csv.find("\nfails,,,,,,,,,\"holds \"\"no\"\" more, sorry\"\n"), std::string::npos);
}

// A form without a row would never be chosen.
TEST(Tune, hasCandidatesOfEveryForm) {
    EXPECT_EQ(encodingCandidates()[0].form, AabbForm::kName);
    for (const FormChoice& form : forms())
        EXPECT_TRUE(std::any_of(encodingCandidates().begin(), encodingCandidates().end(),
                                [&](const EncodingCandidate& c) { return c.form == form.name; }))
            << form.name;
    for (const EncodingCandidate& candidate : encodingCandidates())
        EXPECT_NO_THROW(choose(forms(), "form", candidate.form));
}

TEST(Tune, measuresEveryCandidate) {
    const Scene scene = test::sphereScene(24, 12);
    const Bvh bvh = buildMedian(scene, {});
    Progress progress;
    const std::vector<TunedEncoding> rows =
        measureEncodings(scene, bvh, encodingCandidates(), {.rays = 200, .rounds = 1, .progress = &progress});
    ASSERT_EQ(rows.size(), encodingCandidates().size());
    EXPECT_EQ(progress.done, rows.size());
    EXPECT_EQ(rows[0].nodeBytes, bvh.nodes.size() * sizeof(Node));
    EXPECT_EQ(rows[0].slowdown, 1);
    for (const TunedEncoding& each : rows) {
        EXPECT_EQ(each.refusal, "");
        EXPECT_EQ(each.bytesPerPrimitive, double(each.nodeBytes) / double(scene.triangles.size()));
        EXPECT_GT(each.nc, 1);
        EXPECT_GT(each.blb, 0);
        EXPECT_GT(each.slowdown, 0);
    }
}

// Primary rays hit nothing, so there are no bounced rays. No mean may divide by a count of 0.
TEST(Tune, takesScenesWithoutArea) {
    const Scene scene = test::sceneOf(std::vector<Triangle>(9, {{1, 2, 3}, {1, 2, 3}, {1, 2, 3}}));
    const std::vector<TunedEncoding> rows =
        measureEncodings(scene, buildMedian(scene, {}), encodingCandidates(), {.rays = 50, .rounds = 1});
    for (const TunedEncoding& each : rows) {
        EXPECT_TRUE(std::isfinite(each.slowdown)) << each.candidate.name();
        EXPECT_NE(smallestWithin(rows, 1e9), nullptr);
    }
}

}  // namespace
}  // namespace bvhio
