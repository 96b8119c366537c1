// Reads words and numbers out of text formats (OBJ, ASCII PLY and STL) in one pass, without copying.
#pragma once

#include <charconv>
#include <cstddef>
#include <cstdlib>
#include <span>
#include <string>
#include <string_view>
#include <system_error>

namespace bvhio {

/// A position in a text. Words are separated by blanks; line ends are \n, \r\n or \r. Never reads past the
/// end.
class TextCursor {
  public:
    explicit TextCursor(std::span<const std::byte> bytes)
        : at_(reinterpret_cast<const char*>(bytes.data())), begin_(at_), end_(at_ + bytes.size()) {}

    bool atEnd() const { return at_ == end_; }
    size_t offset() const { return size_t(at_ - begin_); }
    size_t bytesLeft() const { return size_t(end_ - at_); }

    /// Skips blanks within the line.
    void skipBlanks() {
        while (at_ != end_ && (*at_ == ' ' || *at_ == '\t' || *at_ == '\v' || *at_ == '\f')) ++at_;
    }
    /// Skips blanks and line ends.
    void skipSpace() {
        while (at_ != end_ && isSpace(*at_)) ++at_;
    }
    bool atLineEnd() const { return at_ == end_ || *at_ == '\n' || *at_ == '\r'; }
    /// Skips the rest of the line, and its end.
    void skipLine() {
        while (!atLineEnd()) ++at_;
        if (at_ != end_ && *at_++ == '\r' && at_ != end_ && *at_ == '\n') ++at_;
    }
    /// Returns the characters up to the next space; empty at a line end.
    std::string_view word() {
        skipBlanks();
        const char* start = at_;
        while (at_ != end_ && !isSpace(*at_)) ++at_;
        return {start, size_t(at_ - start)};
    }
    /// Returns the rest of the line without its end; skips both.
    std::string_view line() {
        const char* start = at_;
        while (!atLineEnd()) ++at_;
        const std::string_view text(start, size_t(at_ - start));
        skipLine();
        return text;
    }
    bool skip(char c) {
        if (at_ == end_ || *at_ != c) return false;
        ++at_;
        return true;
    }

    /// Reads a whole word as a number, correctly rounded; "nan" and "inf" are numbers. Returns false when the
    /// word is not a number.
    bool number(float& value) { return word(value); }
    bool number(double& value) { return word(value); }
    /// Reads an integer; any other character ends it. Returns false when there is none or it does not fit.
    bool integer(long long& value) {
        skipBlanks();
        if (at_ != end_ && *at_ == '+') ++at_;
        const auto [stop, error] = std::from_chars(at_, end_, value);
        at_ = stop;
        return error == std::errc();
    }
    /// The number of the line that the cursor is in, from 1. Slow, as it counts from the start: for messages.
    size_t lineNumber() const {
        size_t lines = 1;
        for (const char* c = begin_; c != at_; ++c)
            if (*c == '\n' || (*c == '\r' && (c + 1 == end_ || c[1] != '\n'))) ++lines;
        return lines;
    }

  private:
    static bool isSpace(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

    template <class T>
    bool word(T& value) {
        skipBlanks();
        const char* start = at_ != end_ && *at_ == '+' ? at_ + 1 : at_;
        const auto [stop, error] = std::from_chars(start, end_, value);
        if (error == std::errc::invalid_argument) return false;
        if (error == std::errc::result_out_of_range)
            value = T(std::strtod(std::string(start, stop).c_str(), nullptr));
        at_ = stop;
        return at_ == end_ || isSpace(*at_);
    }

    const char* at_;
    const char* begin_;
    const char* end_;
};

}  // namespace bvhio
