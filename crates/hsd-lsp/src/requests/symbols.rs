//! Document symbols.

use super::{DocumentView, RequestResult};
use crate::session::Session;
use gen_lsp_types as lsp;

pub(super) fn symbols(
    session: &mut Session,
    params: lsp::DocumentSymbolParams,
) -> RequestResult<Vec<lsp::DocumentSymbol>> {
    let Some(document) = session.document_view(&params.text_document) else {
        return Ok(vec![]);
    };
    let found = hsd_ide::symbols::symbols(document.analysis);
    Ok(found.into_iter().map(|s| symbol(&document, s)).collect())
}

fn symbol(document: &DocumentView<'_>, from: hsd_ide::symbols::Symbol) -> lsp::DocumentSymbol {
    use hsd_ide::symbols::SymbolKind as Kind;
    let children = from.children.into_iter().map(|c| symbol(document, c));
    #[expect(deprecated)] // the field is deprecated but required
    lsp::DocumentSymbol {
        name: from.name,
        detail: (!from.detail.is_empty()).then_some(from.detail),
        kind: match from.kind {
            Kind::House => lsp::SymbolKind::Class,
            Kind::Storey => lsp::SymbolKind::Namespace,
            Kind::Row | Kind::Loop => lsp::SymbolKind::Array,
            Kind::Facade => lsp::SymbolKind::Interface,
            Kind::Roof => lsp::SymbolKind::Event,
            Kind::Piece => lsp::SymbolKind::Function,
            Kind::Parameter => lsp::SymbolKind::Variable,
            Kind::Value => lsp::SymbolKind::Constant,
            Kind::Part => lsp::SymbolKind::EnumMember,
            Kind::File => lsp::SymbolKind::File,
            Kind::Fitting => lsp::SymbolKind::Property,
        },
        tags: None,
        deprecated: None,
        range: document.places.range_here(&from.range),
        selection_range: document.places.range_here(&from.selection),
        children: Some(children.collect()),
    }
}
