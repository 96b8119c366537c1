// The options of forms, for tools that encode: what forms say of their options, put on a command line.
#pragma once

#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include "common/command_line.h"
#include "compress/form_options.h"

namespace bvhio {

/// Declares the options of all forms. What was given is checked first, and then put among the options of a
/// form.
class FormOptions {
  public:
    enum class Which { everyday, all };
    explicit FormOptions(CommandLine& line, Which which = Which::everyday);

    /// Throws Error{usage} for an option that was given though `form` does not have it, and for a value that
    /// means nothing.
    void check(std::string_view form) const;

    /// `defaults`, which are the form's, with what was given. The values of the other options that the tree
    /// then depends on are filled in, so that provenance records them. Throws Error{usage} for an option that
    /// was given though the tree does not depend on it. For after check.
    EncodeOptions fill(std::string_view form, const EncodeOptions& defaults);

  private:
    /// An option on the command line, and its value: of a choice, the name is in value.text.
    struct Declared {
        OptionInfo info;
        std::vector<std::string_view> forms;  // that have it
        OptionValue value{};
    };

    void gather(Which which);
    void declare(Declared& option, const std::string& help);
    const Declared* find(std::string_view name) const;
    bool isGiven(const OptionInfo& option) const;
    template <class Form>
    typename Form::Options withGiven(typename Form::Options options) const;

    CommandLine& line_;
    std::deque<Declared> options_;  // the command line keeps references to values
};

}  // namespace bvhio
