// Material files: exact round trips, and a refusal that names the offending key for everything else. The wrong files
// are made from a right one, key by key, so that every key of the schema is tried.
#include <gtest/gtest.h>

#include <cstring>
#include <nlohmann/json.hpp>

#include "files.h"
#include "support.h"

using nlohmann::json;

namespace {

test::Material fit(smx_model model) {
    const test::Brdf brdf =
        test::make_brdf(test::beckmann_table({{0.4, 0.03}, {0.6, 0.3}}, oracle::Masking::correlated), "two \"lobes\"");
    return test::fit(test::make_density(brdf, SMX_MASKING_CORRELATED), 4, model);
}

const test::Material &fitted(smx_model model = SMX_MODEL_SHARED) {
    static const std::array<test::Material, 2> materials{fit(SMX_MODEL_SHARED), fit(SMX_MODEL_PER_LOBE)};
    return materials[model == SMX_MODEL_SHARED ? 0 : 1];
}

json saved(smx_material material) {
    const test::TempDir dir;
    EXPECT_SMX_OK(smx_material_save(material, (dir / "m.json").c_str()));
    return json::parse(test::read_file(dir / "m.json"));
}

struct Everything {
    smx_material_info info = SMX_MATERIAL_INFO_INIT;
    smx_fit_report report = SMX_FIT_REPORT_INIT;
    std::vector<smx_lobe> lobes;
    test::Curves curves;
};

Everything everything(smx_material m) {
    Everything e;
    EXPECT_SMX_OK(smx_material_get_info(m, &e.info));
    EXPECT_SMX_OK(smx_material_get_report(m, &e.report));
    e.lobes = test::lobes_of(m);
    e.curves = test::curves_of(m);
    return e;
}

void expect_round_trip(smx_material material) {
    const test::TempDir dir;
    ASSERT_SMX_OK(smx_material_save(material, (dir / "m.json").c_str()));
    test::Material loaded;
    ASSERT_SMX_OK(smx_material_load((dir / "m.json").c_str(), loaded.out()));
    const Everything a = everything(material), b = everything(loaded);
    EXPECT_STREQ(a.info.name, b.info.name);
    EXPECT_STREQ(a.info.source, b.info.source);
    EXPECT_STREQ(a.info.sha256, b.info.sha256);
    EXPECT_EQ(a.info.model, b.info.model);
    EXPECT_EQ(a.curves.theta_d, b.curves.theta_d);
    EXPECT_EQ(a.curves.fresnel, b.curves.fresnel);
    ASSERT_EQ(a.lobes.size(), b.lobes.size());
    EXPECT_EQ(std::memcmp(a.lobes.data(), b.lobes.data(), a.lobes.size() * sizeof(smx_lobe)), 0);
    EXPECT_EQ(a.report.lobes, b.report.lobes);
    EXPECT_EQ(a.report.inversion_iterations, b.report.inversion_iterations);
    EXPECT_EQ(a.report.em_iterations, b.report.em_iterations);
    EXPECT_EQ(a.report.refine_iterations, b.report.refine_iterations);
    EXPECT_EQ(a.report.log_likelihood_em, b.report.log_likelihood_em);
    EXPECT_EQ(a.report.log_likelihood, b.report.log_likelihood);
    EXPECT_EQ(a.report.residual_em, b.report.residual_em);
    EXPECT_EQ(a.report.residual, b.report.residual);
    EXPECT_STREQ(a.report.refine_message, b.report.refine_message);
    EXPECT_EQ(a.report.curve_iterations, b.report.curve_iterations);
    EXPECT_EQ(a.report.brdf_residual_start, b.report.brdf_residual_start);
    EXPECT_EQ(a.report.brdf_residual, b.report.brdf_residual);
    EXPECT_STREQ(a.report.curve_message, b.report.curve_message);
    // Saving what was loaded gives the same file.
    ASSERT_SMX_OK(smx_material_save(loaded, (dir / "again.json").c_str()));
    EXPECT_EQ(test::read_file(dir / "m.json"), test::read_file(dir / "again.json"));
}

void expect_refused(const std::string &text, const std::string &needle) {
    const test::TempDir dir;
    test::write_file(dir / "bad.json", text);
    smx_material material = nullptr;
    EXPECT_SMX_FAILS(SMX_BAD_FORMAT, needle, smx_material_load((dir / "bad.json").c_str(), &material))
        << text.substr(0, 300);
    EXPECT_EQ(material, nullptr);
}

// Pointers to every object member and first array element below `node`.
void collect(const json &node, const json::json_pointer &at, std::vector<json::json_pointer> &all) {
    if (node.is_object())
        for (const auto &item : node.items()) {
            all.push_back(at / item.key());
            collect(item.value(), at / item.key(), all);
        }
    if (node.is_array() && !node.empty()) {
        all.push_back(at / 0);
        collect(node[0], at / 0, all);
    }
}

std::vector<json::json_pointer> pointers(const json &document) {
    std::vector<json::json_pointer> all;
    collect(document, json::json_pointer(), all);
    return all;
}

// The path as messages have it: $.lobes[0].alpha
std::string path_of(json::json_pointer at) {
    std::vector<std::string> steps;
    for (; !at.empty(); at.pop_back()) steps.push_back(at.back());
    std::string path = "$";
    for (auto step = steps.rbegin(); step != steps.rend(); ++step) {
        const bool index = step->find_first_not_of("0123456789") == std::string::npos;
        path += index ? "[" + *step + "]" : "." + *step;
    }
    return path;
}

void check_every_key_must_be_there(const json &document) {
    for (const json::json_pointer &at : pointers(document)) {
        if (!document.at(at.parent_pointer()).is_object()) continue;
        json without = document;
        without.at(at.parent_pointer()).erase(at.back());
        expect_refused(without.dump(), path_of(at));
    }
}

// Deviations of parameters at a bound are null.
bool may_be_null(const json::json_pointer &at) {
    const std::string path = path_of(at);
    return path.starts_with("$.fit.deviations") && path.ends_with("]") && path != "$.fit.deviations.curves[0]";
}

void check_every_value_has_its_type(const json &document) {
    for (const json::json_pointer &at : pointers(document))
        for (const json &wrong : {json(nullptr), json(true), json("text"), json(-0.5), json::object(), json::array()}) {
            const json &right = document.at(at);
            if (wrong.is_null() && may_be_null(at)) continue;
            if (wrong.type() == right.type() || (wrong.is_number() && right.is_number())) continue;
            json changed = document;
            changed.at(at) = wrong;
            expect_refused(changed.dump(), path_of(at));
        }
}

void check_unknown_keys_are_refused(const json &document) {
    std::vector<json::json_pointer> objects{json::json_pointer()};
    for (const json::json_pointer &at : pointers(document))
        if (document.at(at).is_object()) objects.push_back(at);
    for (const json::json_pointer &at : objects) {
        json changed = document;
        changed.at(at)["surplus"] = 1;
        expect_refused(changed.dump(), path_of(at / "surplus"));
    }
}

} // namespace

TEST(MaterialJson, FittedMaterialsComeBackExactly) {
    expect_round_trip(fitted(SMX_MODEL_SHARED));
    expect_round_trip(fitted(SMX_MODEL_PER_LOBE));
}

TEST(MaterialJson, MaterialsFromArraysComeBackExactly) {
    const std::vector<oracle::Lobe> lobes{{1.0, 1e-4}, {1.0 / 3.0, 1e4}, {1e-300, 0.1}};
    expect_round_trip(test::make_material(SMX_MODEL_SHARED, lobes, {0.0, 1.0 / 3.0, 1e-300, 1e10, 0.1, 0.7}, 2));
    std::vector<double> sets(18);
    for (std::size_t k = 0; k < sets.size(); ++k) sets[k] = 1.0 / static_cast<double>(k + 1);
    expect_round_trip(test::make_material(SMX_MODEL_PER_LOBE, lobes, sets, 2));
}

TEST(MaterialJson, FileSaysWhatItIs) {
    const json document = saved(fitted());
    ASSERT_TRUE(document.is_object());
    ASSERT_TRUE(document.contains("version")) << document.dump().substr(0, 300);
    EXPECT_TRUE(document["version"].is_number_integer());
    ASSERT_TRUE(document.contains("lobes"));
    EXPECT_EQ(document["lobes"].size(), test::lobes_of(fitted()).size());
}

TEST(MaterialJson, UnknownVersionIsRefused) {
    json document = saved(fitted());
    document["version"] = 999;
    expect_refused(document.dump(), "version");
    expect_refused(document.dump(), "999");
    document["version"] = "1";
    expect_refused(document.dump(), "version");
}

TEST(MaterialJson, EveryKeyMustBeThere) {
    for (const smx_model model : {SMX_MODEL_SHARED, SMX_MODEL_PER_LOBE})
        check_every_key_must_be_there(saved(fitted(model)));
}

TEST(MaterialJson, EveryValueHasItsType) {
    for (const smx_model model : {SMX_MODEL_SHARED, SMX_MODEL_PER_LOBE})
        check_every_value_has_its_type(saved(fitted(model)));
}

TEST(MaterialJson, UnknownKeysAreRefused) {
    for (const smx_model model : {SMX_MODEL_SHARED, SMX_MODEL_PER_LOBE})
        check_unknown_keys_are_refused(saved(fitted(model)));
}

TEST(MaterialJson, ValuesHaveTheirRanges) {
    const json document = saved(fitted());
    const auto changed = [&](const char *pointer, const json &value) {
        json copy = document;
        copy.at(json::json_pointer(pointer)) = value;
        return copy.dump();
    };
    for (const double alpha : {-0.1, 0.0, 0.99e-4, 1.01e4})
        expect_refused(changed("/lobes/0/alpha", alpha), "$.lobes[0].alpha");
    for (const double weight : {-0.1, 0.0}) expect_refused(changed("/lobes/0/weight", weight), "$.lobes[0].weight");
    expect_refused(changed("/lobes", json::array()), "$.lobes");
    expect_refused(changed("/lobes", json(65, document["lobes"][0])), "$.lobes");
    expect_refused(changed("/model", "glossy"), "$.model");
}

TEST(MaterialJson, TextThatIsNoJsonIsRefused) {
    const std::string good = saved(fitted()).dump();
    for (const std::string &text : {std::string(), std::string("{"), good.substr(0, good.size() / 2), good + "}",
                                    std::string("[]"), std::string("null"), std::string("\xff\xfe\0\0", 4)})
        expect_refused(text, "bad.json");
}

TEST(MaterialJson, DeepNestingIsRefused) { expect_refused(std::string(200000, '['), "bad.json"); }

TEST(MaterialJson, MissingFilesCannotBeRead) {
    const test::TempDir dir;
    smx_material material = nullptr;
    EXPECT_SMX_FAILS(SMX_CANNOT_READ, "absent", smx_material_load((dir / "absent.json").c_str(), &material));
    EXPECT_SMX_FAILS(SMX_CANNOT_READ, dir.path(), smx_material_load(dir.path().c_str(), &material));
    EXPECT_EQ(material, nullptr);
}

TEST(MaterialJson, FailedSavesLoseNothing) {
    const test::TempDir dir;
    test::write_file(dir / "kept.json", "precious");
    {
        const test::FileSizeLimit full(16);
        EXPECT_SMX_FAILS(SMX_CANNOT_WRITE, "kept.json", smx_material_save(fitted(), (dir / "kept.json").c_str()));
    }
    EXPECT_EQ(test::read_file(dir / "kept.json"), "precious");
    EXPECT_SMX_FAILS(SMX_CANNOT_WRITE, "kept.json", smx_material_save(fitted(), (dir / "kept.json/m.json").c_str()));
    EXPECT_SMX_FAILS(SMX_CANNOT_WRITE, "absent", smx_material_save(fitted(), (dir / "absent/m.json").c_str()));
    EXPECT_EQ(dir.names(), std::vector<std::string>{"kept.json"});
    // And a save that works replaces the old file, with nothing left beside it.
    ASSERT_SMX_OK(smx_material_save(fitted(), (dir / "kept.json").c_str()));
    EXPECT_NE(test::read_file(dir / "kept.json"), "precious");
    EXPECT_EQ(dir.names(), std::vector<std::string>{"kept.json"});
}
