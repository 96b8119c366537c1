// The form at the end of a chain, FORM[:KEY=VALUE]...: keys are the options of bvh-compress without their
// dashes, and what EncodeOptions has besides: pointer-bits and line-size of quantized-short, and cut-axes of
// mvh.
#pragma once

#include <string>
#include <vector>

#include "common/form_options.h"
#include "compress/forms.h"
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
    std::string name = words[1].substr(2);
    words.erase(words.begin() + 1);
    choose(forms(), "form", name);
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());

    CommandLine line({"bvh-compress", "", ""}, int(arguments.size()), arguments.data());
    FormOptions given(line);
    EncodeOptions own;
    line.number("--pointer-bits", own.pointerBits, 2, 10, "");
    line.number("--line-size", own.lineSize, 8, 512, "");
    line.number("--cut-axes", own.cutAxes, 0, 3, "");
    line.parse();
    given.check(name, own);
    const bool isShort = name == QuantizedForm::kName && given.isShort(false);
    if (isShort) name = QuantizedShortForm::kName;
    const std::pair<std::string_view, std::string_view> theirs[] = {
        {"--pointer-bits", QuantizedShortForm::kName},
        {"--line-size", QuantizedShortForm::kName},
        {"--cut-axes", MvhForm::kName}};
    for (const auto& [option, form] : theirs)
        if (form != name && line.isGiven(option))
            throw Error(ErrorKind::usage,
                        std::string(option) + ": is for form " + std::string(form) + ", not " + name);
    return {&choose(forms(), "form", name), given.fill(name, own)};
}

}  // namespace bvhio::bench
