// External scanner for what depends on columns or on previous lines.
//
// Legacy form: the kind of a line (from the lines before it and its own form, by the rules of the compiler's parser), codes of five
// columns, and the turns at the ends of walls. XML: the open tags, so that a missing end tag is implied where the next tag requires
// it, and the codes in text, which are split into columns line by line.
//
// All loops terminate at the end of the file. Only the tokens for lines, implied end tags and the end of the file are empty.

#include "tree_sitter/alloc.h"
#include "tree_sitter/parser.h"
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

// In the order of `externals` in grammar.js.
enum Token {
    XML,
    NUMBER_LINE,
    SETTING_LINE,
    WALL_LINE,
    ROOF_LINE,
    SEPARATOR,
    LINE_END,
    SPACE,
    COMMENT,
    WHOLE,
    NAME,
    WIDTH,
    VOID,
    TURN,
    NEXT_STOREY,
    FREE_TEXT,
    START_TAG_NAME,
    END_TAG_NAME,
    OTHER_END_TAG_NAME,
    SELF_CLOSING,
    IMPLICIT_END_TAG,
    CUT,
    RECOVERING,
};

enum { COLUMNS = 5, LINE = 96, DEEPEST = 400 };

enum Form { UNKNOWN, LEGACY, TAGS };
enum Section { HEADER, WALLS, ROOFS };

typedef struct {
    uint8_t form;
    uint8_t section;
    // True if a line of the header was read; true if a blank line follows the last line.
    uint8_t begun, blank;
    // True if a comment was read whose line has not ended yet.
    uint8_t comment;
    // Hashes of the names of open tags. Tags beyond the maximum depth are only counted.
    uint16_t depth;
    uint16_t tags[DEEPEST];
} Scanner;

static bool is_blank(int32_t c) { return c == ' ' || c == '\t' || c == '\f' || c == 0xa0 || c == 0x3000; }
static bool is_break(int32_t c) { return c == '\n' || c == '\r'; }
static bool is_digit(int32_t c) { return c >= '0' && c <= '9'; }
static bool is_upper(int32_t c) { return c >= 'A' && c <= 'Z'; }
static bool is_lower(int32_t c) { return c >= 'a' && c <= 'z'; }
static bool is_letter(int32_t c) { return is_upper(c) || is_lower(c) || c > 0x7f; }
static bool is_in_name(int32_t c) {
    return is_letter(c) || is_digit(c) || c == '_' || c == ':' || c == '-' || c == '.';
}

static void advance(TSLexer *lexer) { lexer->advance(lexer, false); }
static void skip(TSLexer *lexer) { lexer->advance(lexer, true); }

static void to_line_end(TSLexer *lexer) {
    while (!lexer->eof(lexer) && !is_break(lexer->lookahead)) advance(lexer);
}

static bool found(TSLexer *lexer, enum Token token) {
    lexer->result_symbol = token;
    return true;
}

// ---- Kinds of lines.

// The first characters of a line, with 0x7f for those outside ASCII.
typedef struct {
    char text[LINE + 1];
    int length;
} Start;

typedef struct {
    const char *text;
    int length;
} Word;

static Word next_word(const char **text) {
    while (**text == ' ') (*text)++;
    Word word = {*text, 0};
    while (**text != 0 && **text != ' ') {
        (*text)++;
        word.length++;
    }
    return word;
}

static bool is_number(Word w) {
    int i = 0, digits = 0;
    if (i < w.length && (w.text[i] == '+' || w.text[i] == '-')) i++;
    for (; i < w.length && is_digit(w.text[i]); i++) digits++;
    if (i < w.length && w.text[i] == '.') i++;
    for (; i < w.length && is_digit(w.text[i]); i++) digits++;
    return digits > 0 && i == w.length;
}

// Returns true if a word begins like a number.
static bool is_numeric(Word w) {
    int i = 0;
    while (i < w.length && (w.text[i] == '+' || w.text[i] == '-')) i++;
    if (i < w.length && w.text[i] == '.') i++;
    return i < w.length && is_digit(w.text[i]);
}

static char lower(char c) { return is_upper(c) ? (char)(c + 32) : c; }

// Returns true if a word is the key of a setting; `exact` is set if it is spelled correctly.
static bool is_key(Word w, bool exact) {
    static const char *const keys[] = {"unit", "seed", "roofs", "method", "street", "name", "age", "era"};
    int length = 0;
    while (length < w.length && (exact || (w.text[length] != '=' && w.text[length] != ':'))) length++;
    for (size_t k = 0; k < sizeof keys / sizeof *keys; k++) {
        if ((int)strlen(keys[k]) != length) continue;
        int i = 0;
        while (i < length && (exact ? w.text[i] : lower(w.text[i])) == keys[k][i]) i++;
        if (i == length) return true;
    }
    return false;
}

static bool is_shape(Word w) {
    static const char *const shapes = "kir yos yok iri hak hog kat his ter kar rik ";
    if (w.length != 3) return false;
    for (const char *s = shapes; *s != 0; s += 4) {
        if (lower(w.text[0]) == s[0] && lower(w.text[1]) == s[1] && lower(w.text[2]) == s[2]) return true;
    }
    return false;
}

// A letter and a short field, or a shape and two consecutive numbers. Codes begin with letters, so numbers never follow each
// other in them.
static bool is_like_roof(const char *text) {
    Word before[2] = {{0, 0}, {0, 0}};
    bool letter = false, field = false;
    for (int k = 0; k < 16; k++) {
        Word w = next_word(&text);
        if (w.length == 0) break;
        if (k == 0) letter = w.length == 1 && (w.text[0] == '*' || is_letter(w.text[0]));
        if (k == 1) field = w.length <= 2 || is_number(w) || is_shape(w);
        if (k == 2 && letter && field) return true;
        if (k >= 2 && is_shape(before[0]) && is_number(before[1]) && is_number(w)) return true;
        before[0] = before[1];
        before[1] = w;
    }
    return false;
}

// Two upper-case letters, dots, a control letter, optionally after voids.
static bool is_like_codes(const char *text) {
    Word w = next_word(&text);
    if (w.length == 1) return w.text[0] == '^' || lower(w.text[0]) == 'l' || lower(w.text[0]) == 'r';
    return (is_upper(w.text[0]) && is_upper(w.text[1])) || (w.text[0] == '.' && w.text[1] == '.');
}

// A word that is neither a code nor a number is a misspelled key, until a blank line ends the header.
static bool is_strange(Word w) {
    bool small = false;
    for (int i = 0; i < w.length; i++) {
        if (is_upper(w.text[i])) return false;
        small = small || is_lower(w.text[i]) || w.text[i] == 0x7f;
    }
    return small && w.length > 1 && w.text[0] != '.';
}

static enum Token kind_of(Scanner *s, const char *text) {
    const char *rest = text;
    Word first = next_word(&rest);
    bool number = is_numeric(first), roof = is_like_roof(text);
    if (s->section == HEADER) {
        if (!roof && number) return NUMBER_LINE;
        if (!roof && (is_key(first, false) || (is_strange(first) && !(s->begun && s->blank)))) return SETTING_LINE;
        return roof ? ROOF_LINE : WALL_LINE;
    }
    if (is_key(first, true)) return SETTING_LINE;
    if (number && s->blank) return NUMBER_LINE;
    if (s->section == ROOFS) return ROOF_LINE;
    if (!s->blank) return text[0] != 0 && text[1] == ' ' && roof ? ROOF_LINE : WALL_LINE;
    return is_like_codes(text) && !roof ? WALL_LINE : ROOF_LINE;
}

// Looks ahead at the beginning of the line, without adding it to a token.
static void read_start(TSLexer *lexer, Start *start) {
    start->length = 0;
    while (start->length < LINE && !lexer->eof(lexer) && !is_break(lexer->lookahead)) {
        int32_t c = lexer->lookahead;
        start->text[start->length++] = is_blank(c) ? ' ' : c > 0x7f ? 0x7f : c < ' ' ? ' ' : (char)c;
        advance(lexer);
    }
    start->text[start->length] = 0;
}

// Comment markers of other languages are accepted as well; the compiler warns about them.
static bool is_comment(const char *text) {
    return text[0] == '#' || text[0] == ';' || (text[0] == '/' && (text[1] == '/' || text[1] == '*'));
}

static bool line_start(Scanner *s, TSLexer *lexer, const bool *valid) {
    Start start;
    const char *text;
    bool passed = false;
    for (;;) {
        lexer->mark_end(lexer);
        if (lexer->lookahead == '%') {
            advance(lexer);
            lexer->mark_end(lexer);
            s->section = HEADER;
            s->begun = s->blank = s->comment = 0;
            return found(lexer, SEPARATOR);
        }
        read_start(lexer, &start);
        for (text = start.text; *text == ' '; text++) {}
        if (*text != 0) break;
        // Nothing, or more blanks than fit the buffer.
        if (lexer->eof(lexer)) {
            lexer->mark_end(lexer);
            return passed && found(lexer, SPACE);
        }
        passed = true;
        if (is_break(lexer->lookahead)) {
            if (!s->comment) s->blank = 1;
            bool both = lexer->lookahead == '\r';
            skip(lexer);
            if (both && lexer->lookahead == '\n') skip(lexer);
            s->comment = 0;
        } else {
            skip(lexer);
        }
    }
    if (is_comment(text)) {
        to_line_end(lexer);
        lexer->mark_end(lexer);
        s->form = LEGACY;
        s->comment = 1;
        return found(lexer, COMMENT);
    }
    if (s->form == UNKNOWN && *text == '<') {
        s->form = TAGS;
        return valid[XML] && found(lexer, XML);
    }
    s->form = LEGACY;
    enum Token kind = kind_of(s, start.text);
    if (kind == NUMBER_LINE && s->section != HEADER) s->section = HEADER;
    if (kind == NUMBER_LINE || kind == SETTING_LINE) s->begun = 1;
    if (kind == WALL_LINE) s->section = WALLS;
    if (kind == ROOF_LINE) s->section = ROOFS;
    s->blank = s->comment = 0;
    return found(lexer, kind);
}

// ---- Codes.

static bool ends_line(TSLexer *lexer) { return lexer->eof(lexer) || is_break(lexer->lookahead); }

// Skips an XML reference, which is one column wide.
static void reference(TSLexer *lexer) {
    advance(lexer);
    int letters = 0;
    while (letters < 8 && (lexer->lookahead == '#' || is_letter(lexer->lookahead) || is_digit(lexer->lookahead))) {
        advance(lexer);
        letters++;
    }
    if (lexer->lookahead == ';') advance(lexer);
}

// A code or void of up to five columns, of which `count` have been read: blanks, or one letter. `tags` is true in XML text.
static bool cell(TSLexer *lexer, bool tags, int count, bool letter) {
    int last = letter ? 1 : 0, points = 0;
    int32_t before = letter ? 'L' : ' ';
    while (count < COLUMNS && !ends_line(lexer)) {
        int32_t c = lexer->lookahead;
        if (tags ? c == '<' || c == '{' : c == '^') break;
        if (!tags && c == '#' && count > 0 && is_blank(before)) break;
        // The width is a separate token.
        if (count == COLUMNS - 1 && last > 0 && (is_digit(c) || (c == 'h' && is_blank(before)))) {
            return found(lexer, NAME);
        }
        if (tags && c == '&') {
            reference(lexer);
        } else {
            advance(lexer);
        }
        // A misaligned turn.
        bool turn = !tags && last > 0 && (c == 'L' || c == 'R') && is_blank(before);
        if (turn && (ends_line(lexer) || lexer->lookahead == '^')) break;
        before = c;
        count++;
        if (!is_blank(c)) last = count;
        if (c == '.') points++;
        lexer->mark_end(lexer);
    }
    if (points == COLUMNS) return found(lexer, VOID);
    if (last > 0) return found(lexer, WHOLE);
    // Five blanks are a void if the line continues, else trailing blanks.
    while (is_blank(lexer->lookahead)) advance(lexer);
    if (ends_line(lexer)) return false;
    if (tags && (lexer->lookahead == '<' || lexer->lookahead == '{')) {
        lexer->mark_end(lexer);
        return found(lexer, SPACE);
    }
    return found(lexer, count == COLUMNS ? VOID : SPACE);
}

static bool comment(TSLexer *lexer) {
    to_line_end(lexer);
    lexer->mark_end(lexer);
    return found(lexer, COMMENT);
}

static bool line_end(TSLexer *lexer) {
    if (lexer->lookahead == '\r') advance(lexer);
    if (lexer->lookahead == '\n') advance(lexer);
    lexer->mark_end(lexer);
    return found(lexer, LINE_END);
}

// Tokens of a wall line.
static bool wall(TSLexer *lexer, const bool *valid) {
    int32_t first = lexer->lookahead;
    if (first == '#') return comment(lexer);
    if (first == '^') {
        if (!valid[NEXT_STOREY]) return false;
        advance(lexer);
        lexer->mark_end(lexer);
        return found(lexer, NEXT_STOREY);
    }
    bool letter = first == 'L' || first == 'R';
    if (letter) {
        advance(lexer);
        lexer->mark_end(lexer);
        // A single letter is a turn anywhere in the line; the compiler reports what follows it.
        if (ends_line(lexer) || is_blank(lexer->lookahead) || lexer->lookahead == '^') {
            return valid[TURN] && found(lexer, TURN);
        }
    }
    if (valid[WHOLE] && !ends_line(lexer) && cell(lexer, false, letter ? 1 : 0, letter)) return true;
    // Trailing blanks after the last code are part of the line ending.
    while (is_blank(lexer->lookahead)) advance(lexer);
    return ends_line(lexer) && valid[LINE_END] && line_end(lexer);
}

static bool width(TSLexer *lexer) {
    if (!is_digit(lexer->lookahead) && lexer->lookahead != 'h') return false;
    advance(lexer);
    lexer->mark_end(lexer);
    return found(lexer, WIDTH);
}

// The rest of the line without surrounding blanks.
static bool free_text(TSLexer *lexer) {
    while (is_blank(lexer->lookahead)) skip(lexer);
    bool any = false;
    while (!ends_line(lexer)) {
        bool blank = is_blank(lexer->lookahead);
        advance(lexer);
        if (blank) continue;
        lexer->mark_end(lexer);
        any = true;
    }
    return any && found(lexer, FREE_TEXT);
}

static bool legacy(Scanner *s, TSLexer *lexer, const bool *valid) {
    bool recovering = valid[RECOVERING];
    if (recovering) {
        if (lexer->get_column(lexer) == 0) return line_start(s, lexer, valid);
        while (is_blank(lexer->lookahead)) skip(lexer);
        if (is_break(lexer->lookahead)) return line_end(lexer);
        return lexer->lookahead == '#' && comment(lexer);
    }
    if (valid[WIDTH]) return width(lexer);
    if (valid[FREE_TEXT]) return free_text(lexer);
    if (valid[WALL_LINE] || valid[NUMBER_LINE]) return line_start(s, lexer, valid);
    if (valid[WHOLE] || valid[TURN] || valid[NEXT_STOREY]) return wall(lexer, valid);
    while (is_blank(lexer->lookahead)) skip(lexer);
    if (lexer->lookahead == '#') return comment(lexer);
    return ends_line(lexer) && valid[LINE_END] && line_end(lexer);
}

// ---- Tags.

// Reads a name and returns its hash; 0 if there is none.
static uint16_t name(TSLexer *lexer) {
    uint32_t hash = 2166136261u;
    bool any = false;
    while (!lexer->eof(lexer) && is_in_name(lexer->lookahead)) {
        hash = (hash ^ (uint32_t)lexer->lookahead) * 16777619u;
        any = true;
        advance(lexer);
    }
    uint16_t folded = (uint16_t)(hash ^ (hash >> 16));
    return any ? (folded == 0 ? 1 : folded) : 0;
}

static void push(Scanner *s, uint16_t tag) {
    if (s->depth < DEEPEST) s->tags[s->depth] = tag;
    if (s->depth < UINT16_MAX) s->depth++;
}

static void pop(Scanner *s) {
    if (s->depth > 0) s->depth--;
}

static bool is_top(Scanner *s, uint16_t tag) {
    return s->depth > DEEPEST || (s->depth > 0 && s->tags[s->depth - 1] == tag);
}

static bool is_open(Scanner *s, uint16_t tag) {
    for (int i = 0; i < s->depth && i < DEEPEST; i++) {
        if (s->tags[i] == tag) return true;
    }
    return false;
}

// A comment, or an implied end of an open element or tag. `<` is next.
static bool angle(Scanner *s, TSLexer *lexer, const bool *valid) {
    lexer->mark_end(lexer);
    if (valid[CUT] && !valid[RECOVERING]) return found(lexer, CUT);
    advance(lexer);
    if (lexer->lookahead == '/' && valid[IMPLICIT_END_TAG] && !valid[RECOVERING]) {
        advance(lexer);
        uint16_t tag = name(lexer);
        if (tag == 0 || is_top(s, tag) || !is_open(s, tag)) return false;
        pop(s);
        return found(lexer, IMPLICIT_END_TAG);
    }
    if (lexer->lookahead != '!') return false;
    advance(lexer);
    if (lexer->lookahead != '-') return false;
    advance(lexer);
    if (lexer->lookahead != '-') return false;
    advance(lexer);
    int dashes = 0;
    while (!lexer->eof(lexer)) {
        if (lexer->lookahead == '>' && dashes >= 2) {
            advance(lexer);
            break;
        }
        dashes = lexer->lookahead == '-' ? dashes + 1 : 0;
        advance(lexer);
    }
    lexer->mark_end(lexer);
    return found(lexer, COMMENT);
}

static bool tags(Scanner *s, TSLexer *lexer, const bool *valid) {
    bool recovering = valid[RECOVERING];
    if (!recovering && valid[WIDTH]) return width(lexer);
    if (!recovering && valid[START_TAG_NAME]) {
        uint16_t tag = name(lexer);
        if (tag == 0) return false;
        lexer->mark_end(lexer);
        push(s, tag);
        return found(lexer, START_TAG_NAME);
    }
    if (!recovering && valid[END_TAG_NAME]) {
        uint16_t tag = name(lexer);
        if (tag == 0) return false;
        lexer->mark_end(lexer);
        bool same = is_top(s, tag);
        pop(s);
        return found(lexer, same ? END_TAG_NAME : OTHER_END_TAG_NAME);
    }
    // Blanks before a code are columns on the line of its tag, but indentation on later lines.
    lexer->mark_end(lexer);
    int blanks = 0;
    while (is_blank(lexer->lookahead) && blanks < COLUMNS) {
        advance(lexer);
        blanks++;
    }
    if (blanks == COLUMNS) lexer->mark_end(lexer);
    while (is_blank(lexer->lookahead)) advance(lexer);
    int32_t c = lexer->lookahead;
    if (is_break(c)) {
        while (is_break(lexer->lookahead) || is_blank(lexer->lookahead)) advance(lexer);
        lexer->mark_end(lexer);
        return found(lexer, SPACE);
    }
    if (c == '<' || lexer->eof(lexer) || (c == '/' && valid[SELF_CLOSING])) {
        if (blanks > 0) {
            lexer->mark_end(lexer);
            return found(lexer, SPACE);
        }
        if (c == '<') return angle(s, lexer, valid);
        if (recovering) return false;
        if (lexer->eof(lexer)) {
            if (valid[CUT]) return found(lexer, CUT);
            if (!valid[IMPLICIT_END_TAG] || s->depth == 0) return false;
            pop(s);
            return found(lexer, IMPLICIT_END_TAG);
        }
        if (!valid[WHOLE]) {
            advance(lexer);
            if (lexer->lookahead != '>') return false;
            advance(lexer);
            lexer->mark_end(lexer);
            pop(s);
            return found(lexer, SELF_CLOSING);
        }
    }
    if (!valid[WHOLE] || recovering || c == '{') return false;
    if (blanks == COLUMNS) return found(lexer, VOID);
    return cell(lexer, true, blanks, false);
}

// ---- Interface to tree-sitter.

void *tree_sitter_hsd_external_scanner_create(void) { return ts_calloc(1, sizeof(Scanner)); }

void tree_sitter_hsd_external_scanner_destroy(void *payload) { ts_free(payload); }

unsigned tree_sitter_hsd_external_scanner_serialize(void *payload, char *buffer) {
    Scanner *s = payload;
    unsigned kept = s->depth < DEEPEST ? s->depth : DEEPEST;
    buffer[0] = (char)s->form;
    buffer[1] = (char)(s->section | s->begun << 2 | s->blank << 3 | s->comment << 4);
    memcpy(buffer + 2, &s->depth, sizeof s->depth);
    memcpy(buffer + 4, s->tags, kept * sizeof *s->tags);
    return 4 + kept * (unsigned)sizeof *s->tags;
}

void tree_sitter_hsd_external_scanner_deserialize(void *payload, const char *buffer, unsigned length) {
    Scanner *s = payload;
    s->form = s->section = s->begun = s->blank = s->comment = 0;
    s->depth = 0;
    if (length < 4) return;
    s->form = (uint8_t)buffer[0];
    s->section = buffer[1] & 3;
    s->begun = (buffer[1] >> 2) & 1;
    s->blank = (buffer[1] >> 3) & 1;
    s->comment = (buffer[1] >> 4) & 1;
    memcpy(&s->depth, buffer + 2, sizeof s->depth);
    memcpy(s->tags, buffer + 4, length - 4);
}

bool tree_sitter_hsd_external_scanner_scan(void *payload, TSLexer *lexer, const bool *valid) {
    Scanner *s = payload;
    if (s->form == TAGS) return tags(s, lexer, valid);
    return legacy(s, lexer, valid);
}
