-- nvim --headless -u NONE -c 'luafile neovim.lua', with HSD, HSD_ROOT and HSD_WORK in the environment.
-- Tests editors/neovim: file type, highlighting, and the language server. Exits with 1 on failure.
local hsd, root, work = os.getenv('HSD'), os.getenv('HSD_ROOT'), os.getenv('HSD_WORK')

-- A broken file of each form with one error; characters of one, three and four bytes, of one and two UTF-16 units.
local broken = {
  {
    name = '長屋.hsd',
    text = '# 𠮷野家\n0 0 180\n9.5\nname 𠮷野家の店\n\n'
      .. 'KKS  TKD 2MRE\nKSK  ＭＲＥ  KSK\nKKS  TIT 2KKS\nKSK  KSK  KSK',
    line = 6,
    word = 'ＭＲＥ',
    fix = 'MRE',
  },
  {
    name = '町家.hsd',
    text = '<!-- 𠮷野家 -->\n<House name="𠮷野家の店" stret="yes">\n  <Storey height="9.5">\n'
      .. '    <Row>KKS  TKD 2MRE</Row>\n    <Row>KSK  MRE  KSK</Row>\n    <Row>KKS  TIT 2KKS</Row>\n'
      .. '    <Row>KSK  KSK  KSK</Row>\n  </Storey>\n</House>',
    line = 1,
    word = 'stret',
    fix = 'street',
  },
}

local function say(text)
  io.stdout:write(text, '\n')
end

local function check(truth, what)
  if not truth then
    error(what, 2)
  end
end

local function wait(what, test)
  check(vim.wait(20000, test, 20), 'timeout: ' .. what)
end

-- Counts publications, to distinguish no answer yet from no diagnostics.
local published = {}
local publish = vim.lsp.handlers['textDocument/publishDiagnostics']
vim.lsp.handlers['textDocument/publishDiagnostics'] = function(err, result, context, config)
  published[result.uri] = { diagnostics = result.diagnostics, count = ((published[result.uri] or {}).count or 0) + 1 }
  return publish(err, result, context, config)
end

local function uri()
  return vim.uri_from_bufnr(0)
end

local function edit(path)
  vim.cmd('edit! ' .. vim.fn.fnameescape(path))
end

local function client()
  local all = (vim.lsp.get_clients or vim.lsp.get_active_clients)()
  return all[1]
end

local function request(method, params)
  local all = vim.lsp.buf_request_sync(0, method, params, 20000)
  check(all, 'no answer to ' .. method)
  local _, answer = next(all)
  check(answer and not answer.err and not answer.error, method .. ' fails: ' .. vim.inspect(answer))
  return answer.result
end

local function text()
  return table.concat(vim.api.nvim_buf_get_lines(0, 0, -1, false), '\n')
end

-- The protocol's range of a byte range in a line.
local function place(row, column)
  vim.api.nvim_win_set_cursor(0, { row, column })
  return vim.lsp.util.make_position_params(0, client().offset_encoding)
end

local function write(path, content)
  local file = assert(io.open(path, 'w'))
  file:write(content, '\n')
  file:close()
end

local function colours()
  check(require('hsd').build_parser(), 'the parser can be built')
  for _, case in ipairs({
    { 'machiya.hsd', { { 'part', 'GDE ' }, { 'width', '2' }, { 'covering', 'K' }, { 'next_storey', '^' } } },
    { 'param-machiya.hsd', { { 'tag_name', 'House' }, { 'identifier', 'n' }, { 'part', 'GSI' } } },
  }) do
    edit(root .. '/examples/' .. case[1])
    check(vim.bo.filetype == 'hsd', 'the file type is hsd')
    local buffer = vim.api.nvim_get_current_buf()
    check(vim.treesitter.highlighter.active[buffer], 'tree-sitter highlights ' .. case[1])
    local tree = vim.treesitter.get_parser(buffer, 'hsd'):parse()[1]:root()
    check(not tree:has_error(), case[1] .. ' is parsed without errors')
    local get = vim.treesitter.query.get or vim.treesitter.query.get_query
    local seen, query = {}, get('hsd', 'highlights')
    for _, node in query:iter_captures(tree, buffer, 0, -1) do
      local row, from, last, to = node:range()
      if row == last then
        local line = vim.api.nvim_buf_get_lines(buffer, row, row + 1, false)[1]
        seen[node:type() .. ' ' .. line:sub(from + 1, to)] = true
      end
    end
    for _, pair in ipairs(case[2]) do
      check(seen[pair[1] .. ' ' .. pair[2]], 'no highlight for ' .. pair[2])
    end
  end
end

-- Trailing blanks are significant and must be saved.
local function blanks()
  local path = work .. '/blanks.hsd'
  write(path, '0 0 180\n9.5\n\nKSK  TSH 2     \nKSK')
  edit(path)
  vim.api.nvim_buf_set_lines(0, 4, 5, false, { 'KSK  TSH 2     ' })
  vim.cmd('silent write')
  local kept = vim.fn.readfile(path)
  check(kept[4] == 'KSK  TSH 2     ' and kept[5] == kept[4], 'trailing blanks are kept')
end

local function clean_examples()
  for _, path in ipairs(vim.fn.glob(root .. '/examples/*.hsd', true, true)) do
    edit(path)
    wait('diagnostics of ' .. path, function()
      return published[uri()]
    end)
    check(#published[uri()].diagnostics == 0, path .. ' has no diagnostics: ' .. vim.inspect(published[uri()].diagnostics))
  end
end

-- Checks the position of the error in a broken file and applies its fix.
local function check_fix(case)
  local path = work .. '/' .. case.name
  write(path, case.text)
  edit(path)
  wait('a diagnostic', function()
    return #vim.diagnostic.get(0) == 1
  end)
  local diagnostic = vim.diagnostic.get(0)[1]
  local line = vim.api.nvim_buf_get_lines(0, diagnostic.lnum, diagnostic.lnum + 1, false)[1]
  check(diagnostic.lnum == case.line and line:sub(diagnostic.col + 1, diagnostic.end_col) == case.word, 'the error is marked: ' .. vim.inspect(diagnostic))
  local raw = published[uri()].diagnostics
  local actions = request('textDocument/codeAction', {
    textDocument = { uri = uri() }, range = raw[1].range, context = { diagnostics = raw },
  })
  check(actions and #actions > 0, 'a fix is offered')
  local action = actions[1]
  if not action.edit then
    action = request('codeAction/resolve', action)
  end
  vim.lsp.util.apply_workspace_edit(action.edit, client().offset_encoding)
  local fixed = case.text:gsub(case.word, case.fix)
  check(text() == fixed, 'the fix is applied: ' .. text())
  wait('nothing to be wrong any more', function()
    return #vim.diagnostic.get(0) == 0
  end)
end

local function answers()
  local hover = vim.inspect(request('textDocument/hover', place(4, #'    <Row>KKS  T')))
  check(hover:find('格子'), 'the hover of TKD contains its name: ' .. hover)

  -- Replaces a code by the beginning of it.
  local whole = text()
  vim.api.nvim_buf_set_lines(0, 3, 4, false, { '    <Row>KKS  TKMRE</Row>' })
  local list = request('textDocument/completion', place(4, #'    <Row>KKS  TK'))
  local done = false
  for _, item in ipairs(list.items or list) do
    local change = item.textEdit
    if change and vim.trim(change.newText) == 'TKD 2' then
      local range = change.range or change.insert
      vim.lsp.util.apply_text_edits({ { range = range, newText = change.newText } }, vim.api.nvim_get_current_buf(), client().offset_encoding)
      done = true
      break
    end
  end
  check(done and text() == whole, 'TKD 2 is completed: ' .. text())

  vim.api.nvim_buf_set_lines(0, 4, 5, false, { '  <Row>KSK  MRE  KSK</Row>' })
  local edits = request('textDocument/formatting', vim.lsp.util.make_formatting_params())
  vim.lsp.util.apply_text_edits(edits, vim.api.nvim_get_current_buf(), client().offset_encoding)
  check(text() == whole, 'the buffer is formatted: ' .. text())
end

local function renames()
  edit(root .. '/examples/param-machiya.hsd')
  wait('diagnostics', function()
    return published[uri()]
  end)
  local before = text()
  local row = vim.fn.search('"{frontage}"')
  local params = place(row, vim.fn.col('.') + 1)
  params.newName = '間口'
  local change = request('textDocument/rename', params)
  local count = published[uri()].count
  vim.lsp.util.apply_workspace_edit(change, client().offset_encoding)
  local comment, house = before:match('^(.-)(<House.*)$')
  check(text() == comment .. house:gsub('%f[%w_]frontage%f[^%w_]', '間口'), 'every use is renamed: ' .. text())
  wait('diagnostics of the renamed text', function()
    return published[uri()].count > count and #published[uri()].diagnostics == 0
  end)
  check(#vim.diagnostic.get(0) == 0, 'no diagnostics after renaming')
end

local ok, message = xpcall(function()
  vim.o.swapfile = false
  vim.o.hidden = true
  vim.opt.runtimepath:prepend(root .. '/editors/neovim')
  vim.cmd('filetype plugin on')
  require('hsd').setup({ cmd = { hsd, 'lsp' } })
  colours()
  blanks()
  clean_examples()
  for _, case in ipairs(broken) do
    check_fix(case)
  end
  answers()
  renames()
end, debug.traceback)
local version = vim.version()
say(('Neovim %d.%d.%d: %s'):format(version.major, version.minor, version.patch, ok and 'well' or message))
vim.cmd(ok and 'qall!' or 'cquit 1')
