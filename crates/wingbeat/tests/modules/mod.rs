//! Which module of a crate imports which, read from its sources. A file is a module.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use proc_macro2::{TokenStream, TokenTree};
use syn::visit::{self, Visit};
use syn::{Attribute, Item, ItemUse, Macro, Meta, UseTree};

/// Names from the root of the crate, which is empty.
pub type Module = Vec<String>;

/// Modules and what each imports.
pub type Graph = BTreeMap<Module, BTreeSet<Module>>;

/// A file as the resolution of paths needs it.
#[derive(Default)]
struct File {
    /// Items defined here.
    items: BTreeSet<String>,
    /// Names brought in by `use`, with the path each stands for.
    uses: BTreeMap<String, Vec<String>>,
    /// Paths of `use path::*`.
    globs: Vec<Vec<String>>,
    /// All paths written in the file, from the root of the crate.
    paths: Vec<Vec<String>>,
}

/// The graph of the crate with these sources.
pub fn graph(src: &Path, files: &[PathBuf]) -> Graph {
    let names: BTreeSet<Module> = files.iter().map(|f| module(src, f)).collect();
    let mut read: BTreeMap<Module, File> = BTreeMap::new();
    for path in files {
        let text = std::fs::read_to_string(path).expect("a source file");
        let syntax = syn::parse_file(&text).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
        let name = module(src, path);
        let mut reader = Reader {
            here: name.clone(),
            modules: &names,
            file: read.remove(&name).unwrap_or_default(),
        };
        reader.visit_file(&syntax);
        read.insert(name, reader.file);
    }
    let of = |(name, file): (&Module, &File)| {
        let mut targets: BTreeSet<_> = (file.paths.iter())
            .filter_map(|path| resolve(&read, path, 0))
            .collect();
        targets.remove(name);
        (name.clone(), targets)
    };
    read.iter().map(of).collect()
}

/// `src/a/mod.rs` and `src/a.rs` are the module a; lib.rs and main.rs the root.
fn module(src: &Path, file: &Path) -> Module {
    let inside = file.strip_prefix(src).expect("a file of the crate");
    let mut names: Module = inside
        .with_extension("")
        .iter()
        .map(|s| s.to_string_lossy().into_owned())
        .collect();
    let last = names.last().map(String::as_str);
    if last == Some("mod") || names.len() == 1 && matches!(last, Some("lib" | "main")) {
        names.pop();
    }
    names
}

/// The module that defines what a path from the root of the crate names, through any re-exports; None if
/// another crate does.
fn resolve(files: &BTreeMap<Module, File>, path: &[String], depth: usize) -> Option<Module> {
    let mut here = Module::new();
    for (k, name) in path.iter().enumerate() {
        let mut child = here.clone();
        child.push(name.clone());
        if files.contains_key(&child) {
            here = child;
            continue;
        }
        let file = &files[&here];
        if file.items.contains(name) || depth > 16 {
            return Some(here);
        }
        if let Some(other) = file.uses.get(name) {
            let rest = path[k + 1..].iter().cloned();
            let path: Vec<String> = other.iter().cloned().chain(rest).collect();
            return resolve(files, &path, depth + 1);
        }
        let through = |glob: &Vec<String>| {
            let rest = path[k..].iter().cloned();
            let path: Vec<String> = glob.iter().cloned().chain(rest).collect();
            resolve(files, &path, depth + 1)
        };
        return file.globs.iter().find_map(through).or(Some(here));
    }
    Some(here)
}

/// Notes the paths of one file.
struct Reader<'a> {
    here: Module,
    modules: &'a BTreeSet<Module>,
    file: File,
}

impl Reader<'_> {
    /// A path from the root of the crate; None if it leads into another crate or stays within this file.
    fn absolute(&self, path: &[String]) -> Option<Vec<String>> {
        let first = path.first()?;
        let mut from = match first.as_str() {
            "crate" => Module::new(),
            "self" | "super" => self.here.clone(),
            _ => {
                let mut child = self.here.clone();
                child.push(first.clone());
                return self.modules.contains(&child).then(|| {
                    let rest = path[1..].iter().cloned();
                    child.into_iter().chain(rest).collect()
                });
            }
        };
        let mut rest = path;
        while let [name, tail @ ..] = rest {
            match name.as_str() {
                "crate" | "self" => {}
                "super" => drop(from.pop()),
                _ => break,
            }
            rest = tail;
        }
        from.extend(rest.iter().cloned());
        Some(from)
    }

    fn note(&mut self, path: &[String]) {
        if let Some(path) = self.absolute(path) {
            self.file.paths.push(path);
        }
    }

    fn note_use(&mut self, tree: &UseTree, mut path: Vec<String>) {
        match tree {
            UseTree::Path(p) => {
                path.push(p.ident.to_string());
                self.note_use(&p.tree, path);
            }
            UseTree::Group(g) => {
                for tree in &g.items {
                    self.note_use(tree, path.clone());
                }
            }
            UseTree::Glob(_) => {
                self.note(&path);
                self.file.globs.extend(self.absolute(&path));
            }
            UseTree::Name(n) => self.note_name(path, n.ident.to_string(), None),
            UseTree::Rename(r) => {
                self.note_name(path, r.ident.to_string(), Some(r.rename.to_string()));
            }
        }
    }

    fn note_name(&mut self, mut path: Vec<String>, name: String, rename: Option<String>) {
        let known = rename.or_else(|| match name.as_str() {
            "self" => path.last().cloned(),
            _ => Some(name.clone()),
        });
        if name != "self" {
            path.push(name);
        }
        self.note(&path);
        if let (Some(known), Some(path)) = (known, self.absolute(&path)) {
            self.file.uses.insert(known, path);
        }
    }

    /// Paths among the tokens of a macro.
    fn note_tokens(&mut self, tokens: TokenStream) {
        let mut path: Vec<String> = Vec::new();
        let mut colons = 0;
        for token in tokens {
            match &token {
                TokenTree::Ident(name) if path.is_empty() || colons == 2 => {
                    path.push(name.to_string());
                    colons = 0;
                    continue;
                }
                TokenTree::Punct(p) if p.as_char() == ':' && !path.is_empty() => {
                    colons += 1;
                    continue;
                }
                _ => {}
            }
            if path.len() > 1 {
                self.note(&path);
            }
            (path, colons) = (Vec::new(), 0);
            match token {
                TokenTree::Group(group) => self.note_tokens(group.stream()),
                TokenTree::Ident(name) => path.push(name.to_string()),
                _ => {}
            }
        }
        if path.len() > 1 {
            self.note(&path);
        }
    }
}

impl<'ast> Visit<'ast> for Reader<'_> {
    fn visit_item(&mut self, item: &'ast Item) {
        if is_test(attributes(item)) {
            return;
        }
        self.file.items.extend(name(item));
        match item {
            // A module within a file belongs to the file.
            Item::Mod(m) if m.content.is_some() => {
                self.here.push(m.ident.to_string());
                visit::visit_item(self, item);
                self.here.pop();
            }
            _ => visit::visit_item(self, item),
        }
    }

    fn visit_item_use(&mut self, item: &'ast ItemUse) {
        self.note_use(&item.tree, Vec::new());
    }

    fn visit_path(&mut self, path: &'ast syn::Path) {
        let names: Vec<String> = path.segments.iter().map(|s| s.ident.to_string()).collect();
        if names.len() > 1 {
            self.note(&names);
        }
        visit::visit_path(self, path);
    }

    fn visit_macro(&mut self, m: &'ast Macro) {
        self.note_tokens(m.tokens.clone());
        visit::visit_macro(self, m);
    }
}

fn attributes(item: &Item) -> &[Attribute] {
    match item {
        Item::Const(i) => &i.attrs,
        Item::Enum(i) => &i.attrs,
        Item::Fn(i) => &i.attrs,
        Item::Impl(i) => &i.attrs,
        Item::Macro(i) => &i.attrs,
        Item::Mod(i) => &i.attrs,
        Item::Static(i) => &i.attrs,
        Item::Struct(i) => &i.attrs,
        Item::Trait(i) => &i.attrs,
        Item::Type(i) => &i.attrs,
        Item::Use(i) => &i.attrs,
        _ => &[],
    }
}

fn name(item: &Item) -> Option<String> {
    let ident = match item {
        Item::Const(i) => &i.ident,
        Item::Enum(i) => &i.ident,
        Item::Fn(i) => &i.sig.ident,
        Item::Macro(i) => i.ident.as_ref()?,
        Item::Static(i) => &i.ident,
        Item::Struct(i) => &i.ident,
        Item::Trait(i) => &i.ident,
        Item::Type(i) => &i.ident,
        _ => return None,
    };
    Some(ident.to_string())
}

/// Whether these hold `#[cfg(test)]`.
fn is_test(attributes: &[Attribute]) -> bool {
    attributes.iter().any(|a| match &a.meta {
        Meta::List(list) => list.path.is_ident("cfg") && list.tokens.to_string() == "test",
        _ => false,
    })
}

/// What is left when all that imports nothing, or is imported by nothing, has been taken away again and again:
/// the cycles, and what lies between two of them.
pub fn cycles<T: Clone + Ord>(graph: &BTreeMap<T, BTreeSet<T>>) -> BTreeSet<T> {
    let mut left: BTreeSet<T> = graph.keys().cloned().collect();
    loop {
        let imports = |t: &T| graph[t].iter().any(|u| left.contains(u));
        let imported = |t: &T| left.iter().any(|u| graph[u].contains(t));
        let next: BTreeSet<T> = (left.iter())
            .filter(|t| imports(t) && imported(t))
            .cloned()
            .collect();
        if next.len() == left.len() {
            return left;
        }
        left = next;
    }
}

/// For every folder the graph of what stands in it: files, and folders as a whole.
pub fn folders(graph: &Graph) -> BTreeMap<Module, Graph> {
    let mut out: BTreeMap<Module, Graph> = BTreeMap::new();
    for (from, targets) in graph {
        for depth in 0..from.len() {
            let folder = from[..depth].to_vec();
            let member = |m: &Module| m[..(depth + 1).min(m.len())].to_vec();
            let inside = targets.iter().filter(|t| t.starts_with(&folder));
            let members = inside.map(member).filter(|t| *t != member(from));
            let entry = out.entry(folder.clone()).or_default();
            for target in members.collect::<Vec<_>>() {
                entry.entry(target.clone()).or_default();
                entry.entry(member(from)).or_default().insert(target);
            }
        }
    }
    out
}
