;;; emacs.el --- Tests of hsd-mode and eglot  -*- lexical-binding: t; -*-

;; emacs --batch -l emacs.el, with HSD, HSD_ROOT and HSD_WORK in the environment.
;; Tests editors/emacs/hsd-mode.el with eglot: byte compilation without warnings, highlighting, and the language server.
;; Exits with 1 on failure.

;;; Code:

(require 'package)
(package-initialize)
(require 'cl-lib)
(require 'subr-x)
(require 'flymake)
(require 'eglot)

(defconst check-root (getenv "HSD_ROOT"))
(defconst check-work (getenv "HSD_WORK"))
(add-to-list 'load-path (expand-file-name "editors/emacs" check-root))
(require 'hsd-mode)
(setq hsd-program (getenv "HSD")
      eglot-sync-connect 20
      eglot-connect-timeout 20
      eglot-autoshutdown nil
      create-lockfiles nil
      make-backup-files nil)
(prefer-coding-system 'utf-8)

(defconst check-broken
  '(("長屋.hsd" "ＭＲＥ" "MRE"
     "# 𠮷野家\n0 0 180\n9.5\nname 𠮷野家の店\n\nKKS  TKD 2MRE\nKSK  ＭＲＥ  KSK\nKKS  TIT 2KKS\nKSK  KSK  KSK\n")
    ("町家.hsd" "stret" "street"
     "<!-- 𠮷野家 -->
<House name=\"𠮷野家の店\" stret=\"yes\">
  <Storey height=\"9.5\">
    <Row>KKS  TKD 2MRE</Row>
    <Row>KSK  MRE  KSK</Row>
    <Row>KKS  TIT 2KKS</Row>
    <Row>KSK  KSK  KSK</Row>
  </Storey>
</House>
"))
  "A broken file of each form: name, error, fix.
Signs have one, three and four bytes, one and two code units.")

(defun check (truth &rest what)
  "Signal an error of WHAT unless TRUTH."
  (unless truth (error "%s" (apply #'format what))))

(defvar check-published (make-hash-table :test #'equal)
  "For each file, the number of publications and the last diagnostics.")

(cl-defmethod eglot-handle-notification :after
  (_server (_method (eql textDocument/publishDiagnostics)) &key uri diagnostics &allow-other-keys)
  "Record the DIAGNOSTICS published for URI."
  (let ((before (gethash uri check-published '(0))))
    (puthash uri (cons (1+ (car before)) diagnostics) check-published)))

(defun check-diagnostics ()
  "The number of publications for this buffer's file and the last diagnostics."
  (gethash (eglot--path-to-uri buffer-file-name) check-published '(0)))

(defun check-wait (what test)
  "Wait until TEST holds; WHAT describes it."
  (let ((end (+ (float-time) 20)))
    (while (and (not (funcall test)) (< (float-time) end))
      (accept-process-output nil 0.02))
    (check (funcall test) "timeout: %s" what)))

(defun check-open (file)
  "Open FILE with its server and wait for the diagnostics."
  (find-file file)
  (check (eq major-mode 'hsd-mode) "the mode of %s" file)
  (if (eglot-current-server)
      (eglot--maybe-activate-editing-mode)
    (apply #'eglot--connect (eglot--guess-contact)))
  (check (eglot-managed-p) "%s is managed" file)
  (check-wait (concat "diagnostics of " file) (lambda () (> (car (check-diagnostics)) 0))))

(defun check-after (change)
  "Call CHANGE and wait for the new diagnostics."
  (let ((before (car (check-diagnostics))))
    (funcall change)
    (eglot--signal-textDocument/didChange)
    (check-wait "diagnostics of the changed buffer" (lambda () (> (car (check-diagnostics)) before)))))

(defun check-ask (method &rest more)
  "Ask the server for METHOD at point, with MORE parameters."
  (jsonrpc-request (eglot-current-server) method (append (eglot--TextDocumentPositionParams) more)))

(defun check-go (before)
  "Move point after the first BEFORE."
  (goto-char (point-min))
  (search-forward before))

(defun check-mode ()
  "Check the mode without a server."
  (let ((byte-compile-error-on-warn t)
        (byte-compile-dest-file-function (lambda (_) (expand-file-name "hsd-mode.elc" check-work))))
    (check (byte-compile-file (expand-file-name "editors/emacs/hsd-mode.el" check-root))
           "the mode compiles without a warning"))
  (dolist (case '(("machiya.hsd"
                   ("0 0 180" . font-lock-constant-face) ("name" . font-lock-keyword-face)
                   ("GSI  GSI" . font-lock-function-name-face) ("2TOD" . hsd-width)
                   ("^\nKSK" . font-lock-keyword-face) ("K X" . font-lock-type-face)
                   ("# A chu" . font-lock-comment-delimiter-face))
                  ("param-machiya.hsd"
                   ("<!-- A" . font-lock-comment-delimiter-face) ("House name" . font-lock-keyword-face)
                   ("street=" . font-lock-variable-name-face) ("\"machiya\"" . font-lock-string-face)
                   ("{n >= 3}" . font-lock-builtin-face) ("GDE 2" . font-lock-function-name-face))))
    (with-current-buffer (find-file-noselect (expand-file-name (concat "examples/" (car case)) check-root))
      (font-lock-ensure)
      (dolist (pair (cdr case))
        (check-go (car pair))
        (check (eq (get-text-property (match-beginning 0) 'face) (cdr pair)) "the colour of %S in %s is %s" (car pair) (car case)
               (get-text-property (match-beginning 0) 'face)))
      (kill-buffer))))

(defun check-blanks ()
  "Check that trailing blanks are saved."
  (add-hook 'before-save-hook #'delete-trailing-whitespace)
  (let ((file (expand-file-name "blanks.hsd" check-work)) (text "0 0 180\n9.5\n\nKSK  TSH 2     \nKSK\n"))
    (with-current-buffer (find-file-noselect file)
      (insert text)
      (save-buffer)
      (kill-buffer))
    (with-temp-buffer
      (insert-file-contents file)
      (check (equal (buffer-string) text) "trailing blanks are kept")))
  (remove-hook 'before-save-hook #'delete-trailing-whitespace))

(defun check-examples ()
  "Check that the examples have no diagnostics."
  (dolist (file (directory-files (expand-file-name "examples" check-root) t "\\.hsd\\'"))
    (check-open file)
    (check (zerop (length (cdr (check-diagnostics)))) "%s has no diagnostics: %S" file (cdr (check-diagnostics)))))

(defun check-fix (name word fix text)
  "Check that the error WORD in the file NAME with TEXT is marked and becomes FIX."
  (let ((file (expand-file-name name check-work)))
    (with-temp-file file (insert text))
    (check-open file)
    (flymake-start)
    (check-wait "a mark" #'flymake-diagnostics)
    (let* ((mark (car (flymake-diagnostics)))
           (from (flymake-diagnostic-beg mark))
           (to (flymake-diagnostic-end mark)))
      (check (equal (buffer-substring-no-properties from to) word) "the error is marked: %d to %d" from to)
      (let* ((actions (eglot-code-actions from to "quickfix"))
             (action (car actions)))
        (check action "a fix is offered")
        (unless (plist-get action :edit)
          (setq action (jsonrpc-request (eglot-current-server) :codeAction/resolve action)))
        (check-after (lambda () (eglot--apply-workspace-edit (plist-get action :edit))))
        (check (equal (buffer-string) (string-replace word fix text)) "the fix is applied")
        (check (zerop (length (cdr (check-diagnostics)))) "no diagnostics are left")))))

(defun check-answers ()
  "Check hover, completion and formatting."
  (check-go "<Row>KKS  T")
  (let ((card (format "%S" (check-ask :textDocument/hover))))
    (check (string-match-p "格子" card) "the hover of TKD contains its name: %s" card))
  (let ((whole (buffer-string)))
    ;; Replace a code by the beginning of it.
    (check-go "TKD 2")
    (delete-region (match-beginning 0) (match-end 0))
    (insert "TK")
    (eglot--signal-textDocument/didChange)
    (let* ((list (check-ask :textDocument/completion))
           (items (append (if (vectorp list) list (plist-get list :items)) nil))
           (item (cl-find "TKD 2" items :key (lambda (i) (string-trim (or (plist-get (plist-get i :textEdit) :newText) "")))
                          :test #'equal)))
      (check item "TKD 2 is offered with a range")
      (let ((edit (plist-get item :textEdit)))
        (eglot--apply-text-edits (vector (list :range (or (plist-get edit :range) (plist-get edit :insert))
                                               :newText (plist-get edit :newText))))))
    (check (equal (buffer-string) whole) "TKD 2 is completed: %s" (buffer-string))
    (let ((found (save-excursion
                   (check-go "TKD 2")
                   (delete-region (- (point) 3) (point))
                   (prog1 (let ((table (nth 2 (eglot-completion-at-point))))
                            (all-completions "TK" table))
                     (insert "D 2")))))
      (check (cl-some (lambda (c) (string-prefix-p "TKD" c)) found) "eglot offers it too: %S" found))
    (check-go "    <Row>KSK  MRE")
    (replace-match "  <Row>KSK  MRE" t t)
    (eglot-format-buffer)
    (check (equal (buffer-string) whole) "the buffer is formatted: %s" (buffer-string)))
  (set-buffer-modified-p nil))

(defun check-rename ()
  "Check that a parameter is renamed in all its uses."
  (let ((file (expand-file-name "param-machiya.hsd" check-work)))
    (copy-file (expand-file-name "examples/param-machiya.hsd" check-root) file t)
    (check-open file)
    (let* ((start (progn (check-go "-->\n") (point)))
           (case-fold-search nil)
           (expected (concat (buffer-substring-no-properties (point-min) start)
                             (replace-regexp-in-string "\\_<frontage\\_>" "間口"
                                                       (buffer-substring-no-properties start (point-max)) t t))))
      (check-go "\"{fronta")
      (check-after (lambda () (let ((eglot-confirm-server-initiated-edits nil)) (eglot-rename "間口"))))
      (check (equal (buffer-substring-no-properties (point-min) (point-max)) expected) "every use is renamed")
      (check-wait "no diagnostics after renaming" (lambda () (zerop (length (cdr (check-diagnostics)))))))
    (set-buffer-modified-p nil)))

(let ((failed nil))
  (condition-case problem
      (progn
        (check-mode)
        (check-blanks)
        (check-examples)
        (dolist (case check-broken)
          (apply #'check-fix case))
        (check-answers)
        (check-rename))
    (error (setq failed problem)))
  (dolist (server (delete-dups (delq nil (mapcar (lambda (b) (with-current-buffer b (eglot-current-server))) (buffer-list)))))
    (ignore-errors (eglot-shutdown server nil 5)))
  (princ (format "Emacs %s, eglot: %s\n" emacs-version (if failed (error-message-string failed) "passed")))
  (kill-emacs (if failed 1 0)))

;;; emacs.el ends here
