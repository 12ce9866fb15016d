A session with the language server, as an editor has it.

  $ python3 lsp_client.py <<'END'
  > {"id": 1, "method": "textDocument/hover"}
  > {"id": 2, "method": "initialize", "params": {"capabilities": {}}}
  > {"method": "initialized", "params": {}}
  > {"id": 3, "method": "textDocument/hover", "params": {"textDocument": {"uri": "file:///m.dol"}}}
  > {"method": "textDocument/didOpen", "params": {"textDocument": {"uri": "file:///m.dol", "text": "v = pick { type 'UUV' }\nexecute v: imcPlan('a') >>\n"}}}
  > {"method": "textDocument/didChange", "params": {"textDocument": {"uri": "file:///m.dol"}, "contentChanges": [{"text": "v = pick { type 'UUV' }\ndef t(i) { imcPlan('a' + i) }\nexecute v: t(1) >> t(2)\nmessage \"${v}\"; xs = [v ].si\n"}]}}
  > # Places are in units of UTF-16; names of arguments of execute are variables.
  > {"id": 4, "method": "textDocument/references", "params": {"textDocument": {"uri": "file:///m.dol"}, "position": {"line": 2, "character": 8}, "context": {"includeDeclaration": true}}}
  > {"id": 5, "method": "textDocument/definition", "params": {"textDocument": {"uri": "file:///m.dol"}, "position": {"line": 2, "character": 11}}}
  > {"id": 6, "method": "textDocument/hover", "params": {"textDocument": {"uri": "file:///m.dol"}, "position": {"line": 2, "character": 11}}}
  > {"id": 7, "method": "textDocument/rename", "params": {"textDocument": {"uri": "file:///m.dol"}, "position": {"line": 0, "character": 0}, "newName": "i"}}
  > {"id": 8, "method": "textDocument/rename", "params": {"textDocument": {"uri": "file:///m.dol"}, "position": {"line": 0, "character": 0}, "newName": "t"}}
  > {"id": 9, "method": "textDocument/rename", "params": {"textDocument": {"uri": "file:///m.dol"}, "position": {"line": 0, "character": 0}, "newName": "1x"}}
  > {"id": 10, "method": "textDocument/rename", "params": {"textDocument": {"uri": "file:///m.dol"}, "position": {"line": 0, "character": 0}, "newName": "message"}}
  > {"id": 11, "method": "textDocument/prepareRename", "params": {"textDocument": {"uri": "file:///m.dol"}, "position": {"line": 2, "character": 0}}}
  > {"id": 12, "method": "textDocument/documentSymbol", "params": {"textDocument": {"uri": "file:///m.dol"}}}
  > {"id": 13, "method": "textDocument/formatting", "params": {"textDocument": {"uri": "file:///m.dol"}}}
  > {"id": 14, "method": "textDocument/inlineValue", "params": {"textDocument": {"uri": "file:///m.dol"}}}
  > not json
  > []
  > {"id": 15, "method": "shutdown"}
  > {"id": 16, "method": "textDocument/documentSymbol", "params": {"textDocument": {"uri": "file:///m.dol"}}}
  > {"method": "exit"}
  > END
  error -32002: the first request is 'initialize'
  capabilities completionProvider definitionProvider documentFormattingProvider documentHighlightProvider documentSymbolProvider hoverProvider inlayHintProvider positionEncoding referencesProvider renameProvider signatureHelpProvider textDocumentSync
  error -32602: this document is not open
  diagnostics of m.dol
    1:26-1:26 unexpected end of the text
  hint: an expression is expected here
  diagnostics of m.dol
  [{"uri": "file:///m.dol", "range": "0:0-0:1"}, {"uri": "file:///m.dol", "range": "2:8-2:9"}, {"uri": "file:///m.dol", "range": "3:11-3:12"}, {"uri": "file:///m.dol", "range": "3:22-3:23"}]
  {"uri": "file:///m.dol", "range": "1:4-1:5"}
  {"contents": {"kind": "markdown", "value": "```dolphin\ndef t(i)\n```\nA function of line 2."}, "range": "2:11-2:12"}
  {"changes": {"file:///m.dol": [{"range": "0:0-0:1", "newText": "i"}, {"range": "2:8-2:9", "newText": "i"}, {"range": "3:11-3:12", "newText": "i"}, {"range": "3:22-3:23", "newText": "i"}]}}
  error -32803: the name 't' is taken: the program would mean something else
  error -32803: '1x' is not a name
  error -32803: 'message' is a name of the language and cannot be assigned
  null
  [{"name": "v", "kind": 13, "range": "0:0-0:1", "selectionRange": "0:0-0:1"}, {"name": "t", "kind": 12, "range": "1:4-1:5", "selectionRange": "1:4-1:5"}, {"name": "xs", "kind": 13, "range": "3:16-3:18", "selectionRange": "3:16-3:18"}]
  [{"range": "0:0-4:0", "newText": "v = pick { type 'UUV' }\ndef t(i) { imcPlan('a' + i) }\nexecute v: t(1) >> t(2)\nmessage \"${v}\"\nxs = [v].si\n"}]
  error -32601: unknown request 'textDocument/inlineValue'
  error -32700: this is not JSON
  error -32600: this is not a message of the protocol
  null
  error -32600: the server has been shut down

A program and its fleet: each tells of the other's changes. What was opened last is what counts, not the disk.

  $ python3 lsp_client.py <<'END'
  > {"id": 1, "method": "initialize", "params": {}}
  > {"method": "textDocument/didOpen", "params": {"textDocument": {"uri": "file:///m%20x.fleet", "text": "vehicle 'a', { type 'UUV' }\nplan 'survey', { fails }\nplan 'b', { durtion 3 }"}}}
  > {"method": "textDocument/didChange", "params": {"textDocument": {"uri": "file:///m%20x.fleet"}, "contentChanges": [{"text": "vehicle 'a', { type 'UUV' }\nplan 'survey', { fails }\nplan 'b', { fails }"}]}}
  > {"method": "textDocument/didOpen", "params": {"textDocument": {"uri": "file:///m x.dol", "text": "v = pick { id 'a' }\nexecute v: imcPlan('survy')"}}}
  > {"id": 2, "method": "textDocument/completion", "params": {"textDocument": {"uri": "file:///m%20x.fleet"}, "position": {"line": 2, "character": 13}}}
  > {"id": 3, "method": "shutdown"}
  > {"method": "exit"}
  > END
  capabilities completionProvider definitionProvider documentFormattingProvider documentHighlightProvider documentSymbolProvider hoverProvider inlayHintProvider positionEncoding referencesProvider renameProvider signatureHelpProvider textDocumentSync
  diagnostics of m%20x.fleet
    2:12-2:19 a plan has no setting 'durtion'
  hint: did you mean 'duration'?
  diagnostics of m%20x.fleet
  diagnostics of m x.dol
    1:19-1:26 the fleet does not have plan 'survy'
  hint: did you mean 'survey'?
  names duration mayFail fails at only charges
  null

An editor that dies ends the server.

  $ printf 'Content-Length: 5\r\n\r\n{' | dolphin lsp
  dolphin: the input ended amid a message
  [2]
  $ printf 'hello\r\n\r\n' | dolphin lsp
  dolphin: a message begins with Content-Length: BYTES, and an empty line
  [2]
  $ dolphin lsp < /dev/null
  dolphin: the input ended without the notification 'exit'
  [2]
