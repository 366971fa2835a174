//! Semantic tokens, each encoded relative to the previous one.

use super::{DocumentView, RequestResult};
use crate::session::Session;
use gen_lsp_types as lsp;
use hsd_ide::tokens::{Modifiers, Token, TokenKind, tokens};
use serde_json::{Value, json};

/// Token kinds and their names in the protocol, in the order of their numbers.
const KINDS: [(TokenKind, &str); 11] = [
    (TokenKind::Comment, "comment"),
    (TokenKind::Keyword, "keyword"),
    (TokenKind::Element, "type"),
    (TokenKind::Attribute, "property"),
    (TokenKind::String, "string"),
    (TokenKind::Number, "number"),
    (TokenKind::Code, "enumMember"),
    (TokenKind::Parameter, "parameter"),
    (TokenKind::Variable, "variable"),
    (TokenKind::Function, "function"),
    (TokenKind::Operator, "operator"),
];

/// Token modifiers, in the order of their bits.
const MODIFIERS: [&str; 4] = ["declaration", "defaultLibrary", "own", "unknown"];

/// Returns the legend of token kinds and modifiers.
pub(super) fn legend() -> Value {
    let kinds: Vec<&str> = KINDS.iter().map(|(_, name)| *name).collect();
    json!({ "tokenTypes": kinds, "tokenModifiers": MODIFIERS })
}

pub(super) fn full(
    session: &mut Session,
    params: lsp::SemanticTokensParams,
) -> RequestResult<lsp::SemanticTokens> {
    Ok(match session.document_view(&params.text_document) {
        Some(view) => written(&view, &tokens(view.analysis)),
        None => lsp::SemanticTokens::default(),
    })
}

pub(super) fn range(
    session: &mut Session,
    params: lsp::SemanticTokensRangeParams,
) -> RequestResult<lsp::SemanticTokens> {
    let Some(view) = session.document_view(&params.text_document) else {
        return Ok(lsp::SemanticTokens::default());
    };
    let range = view.offsets(params.range);
    let all = tokens(view.analysis);
    let from = all.partition_point(|t| t.range.end <= range.start);
    let to = all.partition_point(|t| t.range.start < range.end);
    Ok(written(&view, all.get(from..to).unwrap_or_default()))
}

fn written(view: &DocumentView<'_>, tokens: &[Token]) -> lsp::SemanticTokens {
    let mut last = view.places.position(0);
    let mut data = Vec::with_capacity(tokens.len());
    for token in tokens {
        let range = view.places.range_here(&token.range);
        let delta_line = range.start.line - last.line;
        let from = if delta_line == 0 { last.character } else { 0 };
        data.push(lsp::SemanticToken {
            delta_line,
            delta_start: range.start.character - from,
            length: range.end.character.saturating_sub(range.start.character),
            token_type: number(token.kind),
            token_modifiers_bitset: bits(token.modifiers),
        });
        last = range.start;
    }
    lsp::SemanticTokens {
        result_id: None,
        data,
    }
}

fn number(kind: TokenKind) -> u32 {
    let at = KINDS.iter().position(|(k, _)| *k == kind);
    at.unwrap_or(0) as u32
}

fn bits(m: Modifiers) -> u32 {
    let set = [m.declaration, m.default_library, m.own, m.unknown];
    let bits = set.iter().enumerate();
    bits.fold(0, |all, (i, on)| all | u32::from(*on) << i)
}
