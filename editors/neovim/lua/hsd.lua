-- HSD support for Neovim 0.7 and later: the language server `hsd lsp`, and tree-sitter highlighting once its parser is built.
--
--   vim.opt.runtimepath:append('/path/to/hsd/editors/neovim')
--   require('hsd').setup()
--
-- `:HsdBuildParser` builds the parser once with the C compiler. `:HsdView` opens the live preview in the browser.
local M = {}

-- The grammar is located relative to this file.
local here = vim.fn.fnamemodify(debug.getinfo(1, 'S').source:sub(2), ':p:h')
local grammar = vim.fn.fnamemodify(here .. '/../../../grammar/tree-sitter-hsd', ':p'):gsub('[/\\]$', '')

local defaults = {
  -- The language server.
  cmd = { 'hsd', 'lsp' },
  -- Tree-sitter highlighting, if the parser is installed.
  treesitter = true,
  -- Called with the client and the buffer, for example to set key mappings.
  on_attach = nil,
  -- Additional options for vim.lsp: capabilities, settings, handlers.
  server = {},
}

-- The root folder: the nearest one with a catalogue or a repository, else the folder of the file. Includes are resolved from there.
local function root_of(file)
  local folder = vim.fn.fnamemodify(file, ':p:h')
  for _, marker in ipairs({ 'catalog.hsd', '.git' }) do
    local found = vim.fn.findfile(marker, folder .. ';')
    if found == '' then
      found = vim.fn.finddir(marker, folder .. ';')
    end
    if found ~= '' then
      return vim.fn.fnamemodify(found, ':p'):gsub('[/\\]$', ''):gsub('[/\\][^/\\]*$', '')
    end
  end
  return folder
end

-- Defaults that Neovim sets itself from 0.8 on.
local function old_defaults(buffer)
  vim.bo[buffer].omnifunc = 'v:lua.vim.lsp.omnifunc'
  vim.bo[buffer].tagfunc = 'v:lua.vim.lsp.tagfunc'
end

local function start_server(options, buffer)
  local config = vim.tbl_deep_extend('force', {
    name = 'hsd',
    cmd = options.cmd,
    root_dir = root_of(vim.api.nvim_buf_get_name(buffer)),
    on_attach = options.on_attach,
  }, options.server)
  if vim.lsp.start then
    vim.lsp.start(config, { bufnr = buffer })
    return
  end
  -- One client per root, like vim.lsp.start.
  for _, client in pairs(vim.lsp.get_active_clients()) do
    if client.name == config.name and client.config.root_dir == config.root_dir then
      vim.lsp.buf_attach_client(buffer, client.id)
      return
    end
  end
  local id = vim.lsp.start_client(config)
  if id then
    vim.lsp.buf_attach_client(buffer, id)
  end
end

-- Path of the parser built by `:HsdBuildParser`.
local function parser_path()
  return vim.fn.stdpath('data') .. '/site/parser/hsd.so'
end

-- Returns whether a parser can be loaded: the one built here, whose folder may be newer than the runtime path, or any other.
local function has_parser()
  local path = vim.fn.filereadable(parser_path()) == 1 and parser_path() or nil
  local ok, added = pcall(function()
    if vim.treesitter.language and vim.treesitter.language.add then
      return vim.treesitter.language.add('hsd', { path = path })
    end
    return vim.treesitter.require_language('hsd', path) or true
  end)
  -- Without a parser, some versions raise an error and 0.11 and later return nil; versions in between return nil on success.
  return ok and (added ~= nil or vim.fn.has('nvim-0.11') == 0)
end

local function set_queries()
  local set = vim.treesitter.query and vim.treesitter.query.set or vim.treesitter.query.set_query
  for _, name in ipairs({ 'highlights', 'folds', 'indents', 'locals', 'textobjects' }) do
    local path = grammar .. '/queries/' .. name .. '.scm'
    if vim.fn.filereadable(path) == 1 then
      set('hsd', name, table.concat(vim.fn.readfile(path), '\n'))
    end
  end
end

-- Highlights a buffer; returns false if there is no parser.
function M.highlight(buffer)
  if not (vim.treesitter and has_parser()) then
    return false
  end
  set_queries()
  if vim.treesitter.start then
    vim.treesitter.start(buffer, 'hsd')
  else
    vim.treesitter.highlighter.new(vim.treesitter.get_parser(buffer, 'hsd'))
  end
  return true
end

-- Builds the parser in the user's data folder, from which Neovim loads it.
function M.build_parser()
  vim.fn.mkdir(vim.fn.fnamemodify(parser_path(), ':h'), 'p')
  local source = grammar .. '/src'
  local compiler = os.getenv('CC') or 'cc'
  local output = vim.fn.system({
    compiler, '-shared', '-fPIC', '-O2', '-std=c11', '-I', source,
    '-o', parser_path(), source .. '/parser.c', source .. '/scanner.c',
  })
  if vim.v.shell_error ~= 0 then
    vim.notify('hsd: the parser cannot be built: ' .. output, vim.log.levels.ERROR)
    return false
  end
  for _, buffer in ipairs(vim.api.nvim_list_bufs()) do
    if vim.api.nvim_buf_is_loaded(buffer) and vim.bo[buffer].filetype == 'hsd' then
      M.highlight(buffer)
    end
  end
  return true
end

-- Opens the live preview of the current buffer, including unsaved changes.
function M.view()
  local buffer = vim.api.nvim_get_current_buf()
  local params = { command = 'hsd.view', arguments = { vim.uri_from_bufnr(buffer), true } }
  vim.lsp.buf_request(buffer, 'workspace/executeCommand', params, function(problem, url)
    vim.notify(problem and problem.message or url, problem and vim.log.levels.ERROR or vim.log.levels.INFO)
  end)
  -- The preview highlights the part under the cursor.
  vim.api.nvim_create_autocmd('CursorHold', {
    group = vim.api.nvim_create_augroup('hsd-view', { clear = true }),
    pattern = '*.hsd',
    callback = function(event)
      for _, client in pairs((vim.lsp.get_clients or vim.lsp.get_active_clients)({ bufnr = event.buf })) do
        if client.name == 'hsd' then
          client.notify('hsd/cursor', vim.lsp.util.make_position_params(0, client.offset_encoding))
        end
      end
    end,
  })
end

function M.setup(given)
  local options = vim.tbl_deep_extend('force', defaults, given or {})
  local native = vim.fn.has('nvim-0.11') == 1 and vim.lsp.config ~= nil
  if native then
    vim.lsp.config('hsd', vim.tbl_deep_extend('force', {
      cmd = options.cmd,
      filetypes = { 'hsd' },
      root_markers = { 'catalog.hsd', '.git' },
      on_attach = options.on_attach,
    }, options.server))
    vim.lsp.enable('hsd')
  end
  local function enter(buffer)
    if options.treesitter then
      M.highlight(buffer)
    end
    if not native then
      old_defaults(buffer)
      start_server(options, buffer)
    end
  end
  local group = vim.api.nvim_create_augroup('hsd', { clear = true })
  vim.api.nvim_create_autocmd('FileType', {
    group = group,
    pattern = 'hsd',
    callback = function(event)
      enter(event.buf)
    end,
  })
  vim.api.nvim_create_user_command('HsdBuildParser', M.build_parser, {})
  vim.api.nvim_create_user_command('HsdView', M.view, {})
  -- Buffers that are already open.
  for _, buffer in ipairs(vim.api.nvim_list_bufs()) do
    if vim.api.nvim_buf_is_loaded(buffer) and vim.bo[buffer].filetype == 'hsd' then
      enter(buffer)
    end
  end
end

return M
