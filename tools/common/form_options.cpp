#include "common/form_options.h"

#include <algorithm>

#include "core/error.h"

namespace bvhio {
namespace {

/// "a or b".
std::string alternatives(const std::vector<std::string_view>& names) {
    std::string text;
    for (size_t i = 0; i < names.size(); ++i)
        text.append(i == 0 ? "" : i + 1 == names.size() ? " or " : ", ").append(names[i]);
    return text;
}

/// Who uses an option, and its default there: "mvh, default 4".
struct OptionUser {
    std::string_view name;
    std::string byDefault;
};

/// "triangles per leaf (mvh: default 4; mvh BLASes: default 16)"; a default that all have alike comes once.
std::string helpOf(const OptionInfo& option, const std::vector<OptionUser>& users) {
    const bool areAlike = std::all_of(users.begin(), users.end(), [&](const OptionUser& user) {
        return user.byDefault == users[0].byDefault;
    });
    std::string text = std::string(option.help) + " (";
    for (size_t i = 0; i < users.size(); ++i) {
        text.append(i == 0 ? "" : areAlike ? ", " : "; ").append(users[i].name);
        if (!areAlike) text.append(": default ").append(users[i].byDefault);
    }
    return areAlike ? text + "; default " + users[0].byDefault + ")" : text + ")";
}

template <class Function>
void forEachForm(const Function& function) {
    for (const FormChoice& form : forms()) visitForm(form.name, function);
}

/// The options as a command line lists them: each once, as the form has it that describes it.
std::vector<OptionInfo> listOptions(FormOptions::Which which) {
    std::vector<OptionInfo> all;
    forEachForm([&]<class Form>(std::type_identity<Form>) {
        for (const OptionInfo& option : Form::optionTable())
            if (option.part.empty() && (option.isEveryday || which == FormOptions::Which::all))
                all.push_back(option);
    });
    std::stable_sort(all.begin(), all.end(),
                     [](const OptionInfo& a, const OptionInfo& b) { return a.place < b.place; });
    return all;
}

}  // namespace

FormOptions::FormOptions(CommandLine& line, Which which) : line_(line) {
    for (const OptionInfo& info : listOptions(which)) {
        Declared& option = options_.emplace_back(Declared{info, {}});
        std::vector<OptionUser> users;
        forEachForm([&]<class Form>(std::type_identity<Form>) {
            for (const auto& row : Form::optionTable()) {
                if (row.name != info.name) continue;
                option.forms.push_back(Form::kName);
                users.push_back({row.part.empty() ? Form::kName : row.part, defaultText(row)});
            }
        });
        declare(option, helpOf(info, users));
    }
}

void FormOptions::declare(Declared& option, const std::string& help) {
    const OptionInfo& info = option.info;
    const std::string name(info.name);
    switch (info.kind) {
        case OptionKind::number:
            line_.number(name, option.value.number, info.min, info.max, help);
            break;
        case OptionKind::choice:
            line_.choice(name, option.value.text, {info.values.begin(), info.values.end()}, help);
            break;
        case OptionKind::text:
            line_.text(name, std::string(info.valueName), option.value.text, help);
            break;
    }
}

bool FormOptions::isGiven(const OptionInfo& option) const {
    return find(option.name) != nullptr && line_.isGiven(option.name);
}

const FormOptions::Declared* FormOptions::find(std::string_view name) const {
    for (const Declared& option : options_)
        if (option.info.name == name) return &option;
    return nullptr;
}

template <class Form>
typename Form::Options FormOptions::withGiven(typename Form::Options options) const {
    for (const auto& row : Form::optionTable()) {
        if (!isGiven(row)) continue;
        OptionValue value = find(row.name)->value;
        if (row.kind == OptionKind::choice) value.number = indexOfValue(row, value.text);
        row.set(options, value);
    }
    return options;
}

void FormOptions::check(std::string_view form) const {
    for (const Declared& option : options_)
        if (line_.isGiven(option.info.name) &&
            std::find(option.forms.begin(), option.forms.end(), form) == option.forms.end())
            throw Error(ErrorKind::usage, std::string(option.info.name) + ": is for --form " +
                                              alternatives(option.forms) + ", not " + std::string(form) +
                                              ": leave it out");
    visitForm(form, [&]<class Form>(std::type_identity<Form>) { withGiven<Form>({}); });
}

EncodeOptions FormOptions::fill(std::string_view form, const EncodeOptions& defaults) {
    return visitForm(form, [&]<class Form>(std::type_identity<Form>) -> EncodeOptions {
        const auto options = withGiven<Form>(optionsFor<Form>(defaults));
        for (const auto& row : Form::optionTable()) {
            if (isGiven(row)) {
                if (!row.isUsed(options))
                    throw Error(ErrorKind::usage, std::string(row.name) + ": is for " +
                                                      std::string(row.part) +
                                                      ", which this tree does not have: leave it out");
                continue;
            }
            const auto option = std::find_if(options_.begin(), options_.end(), [&](const Declared& each) {
                return each.info.name == row.name;
            });
            if (option == options_.end() || !row.isUsed(options)) continue;
            option->value = row.get(options);
            if (row.kind == OptionKind::choice) option->value.text = row.values[option->value.number].name;
        }
        return options;
    });
}

}  // namespace bvhio
