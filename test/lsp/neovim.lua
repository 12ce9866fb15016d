-- A session of an editor: opens a program with the files of editors/vim, attaches the server, and prints what it says.
vim.opt.swapfile = false

local out = {}
local function say(...) table.insert(out, table.concat(vim.tbl_map(tostring, { ... }), ' ')) end
local function finish()
  vim.fn.writefile(out, vim.env.OUT)
  vim.cmd('qall!')
end

vim.cmd('edit ' .. vim.env.MISSION)
say('filetype', vim.bo.filetype, 'shiftwidth', vim.bo.shiftwidth, 'formatprg', vim.bo.formatprg)
local function group(line, column) return vim.fn.synIDattr(vim.fn.synID(line, column, 1), 'name') end
say('syntax', group(1, 1), group(2, 10), group(2, 23), group(2, 31), group(4, 1))

local client = require('dolphin').start({ vim.env.DOLPHIN, 'lsp' })
if not vim.wait(20000, function() return #vim.diagnostic.get(0) > 0 end, 20) then
  say('no diagnostics came')
  return finish()
end
for _, d in ipairs(vim.diagnostic.get(0)) do
  say(string.format('%d:%d %s', d.lnum + 1, d.col + 1, d.message:gsub('\n', '; ')))
end

local function ask(method, line, column, more)
  local parameters = vim.tbl_extend('force', {
    textDocument = vim.lsp.util.make_text_document_params(),
    position = { line = line - 1, character = column - 1 },
  }, more or {})
  local answers = vim.lsp.buf_request_sync(0, method, parameters, 20000)
  local answer = answers and answers[client]
  return answer and (answer.result or answer.error)
end

say('hover', (ask('textDocument/hover', 4, 2).contents.value:gsub('\n', ' ')))
say('definition', ask('textDocument/definition', 4, 9).range.start.line + 1)
say('references', #ask('textDocument/references', 4, 9, { context = { includeDeclaration = true } }))
local names = vim.tbl_map(function(item) return item.label end, ask('textDocument/completion', 2, 17))
say('completion', vim.tbl_contains(names, 'payload'), vim.tbl_contains(names, 'execute'))
local plans = vim.tbl_map(function(item) return item.label end, ask('textDocument/completion', 4, 26))
say('plans', table.concat(plans, ' '))

local edit = ask('textDocument/rename', 4, 9, { newName = 'team' })
vim.lsp.util.apply_workspace_edit(edit, 'utf-16')
vim.lsp.util.apply_text_edits(ask('textDocument/formatting', 1, 1, { options = { tabSize = 4, insertSpaces = true } }),
  0, 'utf-16')
for _, line in ipairs(vim.api.nvim_buf_get_lines(0, 0, -1, false)) do say('|', line) end

-- Mended by hand: the faults go, and it is said which vehicle runs what.
vim.api.nvim_buf_set_lines(0, -2, -1, false, { "message 'done'" })
say('mended', vim.wait(20000, function() return #vim.diagnostic.get(0) == 0 end, 20))
local whole = { start = { line = 0, character = 0 }, ['end'] = { line = 99, character = 0 } }
for _, hint in ipairs(ask('textDocument/inlayHint', 1, 1, { range = whole })) do
  say('hint', hint.position.line + 1, hint.label)
end
vim.lsp.stop_client(client)
finish()
