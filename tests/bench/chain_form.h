// The form at the end of a chain, FORM[:KEY=VALUE]...: keys are the options of the form without their dashes,
// those that bvh-compress leaves out among them.
#pragma once

#include <string>
#include <vector>

#include "common/form_options.h"
#include "core/split.h"

namespace bvhio::bench {

struct ChainForm {
    const FormChoice* form;
    EncodeOptions options;
};

/// Throws Error{usage} as bvh-compress does.
inline ChainForm formOfChain(const std::string& text) {
    std::vector<std::string> words = {"bvh-compress"};
    for (const std::string_view part : split(text, ':')) words.push_back("--" + std::string(part));
    const std::string name = words[1].substr(2);
    words.erase(words.begin() + 1);
    const FormChoice& form = choose(forms(), "form", name);
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());

    CommandLine line({"bvh-compress", "", ""}, int(arguments.size()), arguments.data());
    FormOptions given(line, FormOptions::Which::all);
    line.parse();
    given.check(name);
    return {&form, given.fill(name, {})};
}

}  // namespace bvhio::bench
